//! The content of a part, without its codings.

use std::io::Read;

use axum::http::HeaderMap;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::MultiGzDecoder;

use crate::http::problem::{Problem, ProblemType};

/// First bytes of a gzip file (RFC 1952). No picture, message or text begins so.
const GZIP: [u8; 3] = [0x1f, 0x8b, 0x08];

/// The content of a part, out of base64 (`Content-Transfer-Encoding`) and gzip (`Content-Encoding`, or a file that is
/// gzip), at most `limit` bytes. O(bytes): large parts are read beside the runtime's threads.
///
/// # Errors
/// 415 for another coding, 422 for content that is not in its coding, 413 over the limit, with the pointer of the part.
pub fn plain_content(name: &str, headers: &HeaderMap, content: Vec<u8>, limit: usize) -> Result<Vec<u8>, Problem> {
    let pointer = || format!("/{name}");
    let coding = |header: &str| -> String {
        headers
            .get(header)
            .map(|value| String::from_utf8_lossy(value.as_bytes()).trim().to_lowercase())
            .unwrap_or_default()
    };
    let strange = |coding: &str| {
        let detail = format!("the part is encoded as {coding:.20}: send it as it is, in gzip or in base64");
        Problem::at(ProblemType::UnsupportedMediaType, pointer(), detail)
    };
    let content = match coding("content-transfer-encoding").as_str() {
        "" | "binary" | "8bit" | "7bit" => content,
        "base64" => {
            let text: Vec<u8> = content.into_iter().filter(|byte| !byte.is_ascii_whitespace()).collect();
            STANDARD
                .decode(text)
                .map_err(|_| Problem::invalid(pointer(), "the part says that it is base64, and is not"))?
        }
        other => return Err(strange(other)),
    };
    match coding("content-encoding").as_str() {
        "" | "identity" if !content.starts_with(&GZIP) => Ok(content),
        "" | "identity" | "gzip" | "x-gzip" => {
            let mut plain = Vec::new();
            let read = MultiGzDecoder::new(content.as_slice()).take(limit as u64 + 1).read_to_end(&mut plain);
            read.map_err(|_| Problem::invalid(pointer(), "the part is broken gzip: compress or upload it again"))?;
            if plain.len() > limit {
                let detail = format!("the part is over its limit of {limit} bytes once decompressed");
                return Err(Problem::at(ProblemType::TooLarge, pointer(), detail));
            }
            Ok(plain)
        }
        other => Err(strange(other)),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn gzip(content: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(content).unwrap();
        encoder.finish().unwrap()
    }

    fn read(headers: &[(&'static str, &'static str)], content: &[u8]) -> Result<Vec<u8>, String> {
        let header = |&(name, value): &(&'static str, &'static str)| (name.parse().unwrap(), value.parse().unwrap());
        let headers: HeaderMap = headers.iter().map(header).collect();
        plain_content("image", &headers, content.to_vec(), 1_000)
            .map_err(|problem| format!("{} {}", problem.kind().status().as_u16(), problem.message()))
    }

    #[test]
    fn contents_come_out_of_their_codings() {
        let plain = Ok(b"P5 1 1".to_vec());
        assert_eq!(read(&[], b"P5 1 1"), plain);
        assert_eq!(read(&[("content-transfer-encoding", "binary")], b"P5 1 1"), plain);
        assert_eq!(read(&[("content-transfer-encoding", "Base64")], b"UDUg\r\nMSAx\r\n"), plain);
        assert_eq!(read(&[("content-encoding", "gzip")], &gzip(b"P5 1 1")), plain);
        assert_eq!(read(&[], &gzip(b"P5 1 1")), plain, "a .pgm.gz");
    }

    #[test]
    fn other_codings_and_bombs_are_refused_by_name() {
        let refusal = |headers: &[_], content: &[u8]| read(headers, content).unwrap_err();
        expect_test::expect!["415 /image: the part is encoded as zstd: send it as it is, in gzip or in base64"]
            .assert_eq(&refusal(&[("content-encoding", "zstd")], b""));
        expect_test::expect![
            "415 /image: the part is encoded as quoted-printable: send it as it is, in gzip or in base64"
        ]
        .assert_eq(&refusal(&[("content-transfer-encoding", "quoted-printable")], b""));
        expect_test::expect!["422 /image: the part says that it is base64, and is not"]
            .assert_eq(&refusal(&[("content-transfer-encoding", "base64")], b"\x89PNG"));
        expect_test::expect!["422 /image: the part is broken gzip: compress or upload it again"]
            .assert_eq(&refusal(&[("content-encoding", "gzip")], b"P5 1 1"));
        expect_test::expect!["413 /image: the part is over its limit of 1000 bytes once decompressed"]
            .assert_eq(&refusal(&[], &gzip(&[0; 10_000])));
    }
}
