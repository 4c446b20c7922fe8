//! Corrections of maps drawn in characters.

use super::*;
use crate::semantics::pictures::DrawnMap;

/// Reads a correction as a client writes it.
fn read(json: &str) -> Correction {
    serde_json::from_str(json).expect("it is a correction")
}

#[test]
fn a_correction_is_written_as_it_is_read() {
    for json in [
        r#"{"kind":"draw","ring":[[0.0,0.0],[1.0,0.0],[1.0,1.0]],"label":"pc","name":"Rack 12"}"#,
        r#"{"kind":"split","line":[[0.0,0.5],[1.0,0.5]]}"#,
        r#"{"kind":"merge","at":[[0.0,0.5],[1.0,0.5]]}"#,
        r#"{"kind":"row","rectangle":[[0.0,0.0],[9.0,0.0],[9.0,1.0],[0.0,1.0]],"pitchM":1.2,"layers":1}"#,
        r#"{"kind":"erase","ring":[[0.0,0.0],[1.0,0.0],[1.0,1.0]]}"#,
        r#"{"kind":"label","at":[3.0,4.0],"label":"co"}"#,
        r#"{"kind":"door","line":[[0.0,0.0],[0.0,1.0]],"isOpen":true}"#,
        r#"{"kind":"name","at":[3.0,4.0],"name":"Cold store"}"#,
    ] {
        assert_eq!(serde_json::to_string(&read(json)).expect("it can be written"), json);
    }
    let whole_numbers = read(r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":12}"#);
    assert!(matches!(whole_numbers, Correction::Row { places: Some(12), layers: 1, .. }));
    assert!(serde_json::from_str::<Correction>(r#"{"kind":"label","at":[3,4],"label":"co","colour":1}"#).is_err());
}

#[test]
fn a_label_goes_to_the_face_at_its_point() {
    let map = DrawnMap::new("....\n....", "ccpp\nccpp");
    let label = read(r#"{"kind":"label","at":[1.6,0.2],"label":"ju"}"#);
    let outside = read(r#"{"kind":"label","at":[9,0.2],"label":"ju"}"#);
    let corrected = apply(&map.grid, &map.analysis, &map.cells.faces, &[label, outside]);
    let Outcome::Applied { faces } = &corrected.outcomes[0] else { panic!("{:?}", corrected.outcomes) };
    assert_eq!((faces.len(), map.letter(faces[0]), corrected.labels[&faces[0]].as_str()), (1, 'p', "ju"));
    assert!(matches!(&corrected.outcomes[1], Outcome::Unfit(problem) if problem.pointer == "/at"));
}
