//! The same upload gives the same answers, whatever computes and keeps it.

use crate::deployment::Deployment;
use crate::server::{Server, hall_message};
use crate::settings::PATIENCE;

/// What is compared, below a map.
const LAYERS: [&str; 5] = ["faces", "edges", "nodes", "locations", "aisles"];

/// The layers of the only map of a deployment, without what names the map and the service.
fn layers(server: &Server) -> Vec<String> {
    let map = server.maps().pop().expect("one map");
    let layer = |name: &str| {
        let answer = server.ask(&format!("/v1/maps/{map}/collections/{name}/items?limit=10000")).expect("it answers");
        assert_eq!(answer.status, 200, "{name}: {}", answer.text);
        answer.text.replace(&map, "MAP").replace(server.address(), "SERVICE")
    };
    LAYERS.map(layer).to_vec()
}

#[test]
fn engines_threads_and_crashes_make_no_difference() {
    let mut first: Option<Vec<String>> = None;
    for threads in ["1", "2", "8"] {
        for deployment in [Some(Deployment::embedded()), Deployment::shared()].into_iter().flatten() {
            let arguments = ["--compute-threads", threads];
            let mut dying = Server::start(&deployment, Some("during-compute"), &arguments).expect("it starts");
            dying.upload(&hall_message(120, 72), "hall").expect("accepted");
            assert_eq!(dying.wait_for_death(PATIENCE), Some(9));
            let server = Server::start(&deployment, None, &arguments).expect("the next process starts");
            server.wait_until_idle(PATIENCE);
            let layers = layers(&server);
            server.stop();
            let first = first.get_or_insert_with(|| layers.clone());
            assert!(first[0].len() > 2_000, "there are faces: {}", first[0]);
            assert_eq!(*first, layers, "{threads} threads, database {:?}", deployment.database());
        }
    }
}
