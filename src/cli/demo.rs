//! `stillage demo`: the whole service in a minute, on an example map and a store that is gone at the end.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use stillage_core::AnalysisOptions;
use tokio::net::TcpListener;
use uuid::Uuid;

use super::failure::Failure;
use crate::app::{App, AppError, Caller, JobRecord, JobState, MapContext, NewMap};
use crate::config::Config;
use crate::ingest::MapSource;
use crate::server::{self, ConnectionLimits};

/// A generated warehouse; `examples/README.md` tells how it was made.
const IMAGE: &[u8] = include_bytes!("../../examples/warehouse.png");
const METADATA: &[u8] = include_bytes!("../../examples/warehouse.yaml");

/// The demo serves one person.
const CONNECTIONS: ConnectionLimits = ConnectionLimits { in_all: 64, of_address: 64 };

/// Arguments of `stillage demo`.
#[derive(Debug, clap::Args)]
pub(super) struct DemoArgs {
    /// Loopback address to listen on; port 0 takes a free one.
    #[arg(long, default_value = "127.0.0.1:8080", value_name = "ADDRESS")]
    listen: SocketAddr,
    /// End after the summary instead of serving on.
    #[arg(long)]
    exit: bool,
}

/// Runs the command.
pub(super) fn run(arguments: &DemoArgs) -> Result<(), Failure> {
    if !arguments.listen.ip().is_loopback() {
        return Err(Failure::Input(
            "the demo has no API keys: listen on a loopback address such as 127.0.0.1:8080".into(),
        ));
    }
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().map_err(Failure::internal)?;
    runtime.block_on(demo(arguments))
}

async fn demo(arguments: &DemoArgs) -> Result<(), Failure> {
    let listener = TcpListener::bind(arguments.listen).await.map_err(|error| {
        Failure::Input(format!(
            "cannot listen on {}: {error}; `--listen 127.0.0.1:0` takes a free port",
            arguments.listen
        ))
    })?;
    let base = format!("http://{}", listener.local_addr().map_err(Failure::internal)?);
    let folder = tempfile::tempdir().map_err(Failure::internal)?;
    let app = App::open(Config { shutdown_notice: Duration::ZERO, ..Config::new(folder.path()) })
        .await
        .map_err(Failure::internal)?;

    let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
    let serving = tokio::spawn(server::serve(listener, None, app.clone(), CONNECTIONS, async {
        // A dropped sender (a failed upload) stops the service as well.
        let _ = stopped.await;
    }));
    let shown = show(&app, &base).await;
    if shown.is_ok() && !arguments.exit {
        println!("\nServing {base} until you press Ctrl-C; the store is deleted then.");
        tokio::signal::ctrl_c().await.map_err(Failure::internal)?;
    }
    drop(stop);
    serving.await.map_err(Failure::internal)?;
    shown
}

/// Uploads the example, waits for its job and tells what came out.
async fn show(app: &App, base: &str) -> Result<(), Failure> {
    let map = NewMap {
        source: MapSource::Image { image: IMAGE.to_vec(), metadata: METADATA.to_vec() },
        name: "Example warehouse".to_owned(),
        options: AnalysisOptions::default(),
        georeference: None,
        previous: None,
        idempotency_key: None,
    };
    let caller = Caller::local();
    let (job, _) = app.create_map(&caller, map).await.map_err(Failure::internal)?;
    let job = wait(app, &caller, job.id).await.map_err(Failure::internal)?;
    if job.state != JobState::Successful {
        return Err(Failure::Internal(format!("the job ended {:?}: {}", job.state, job.message)));
    }
    let context = app.context(&caller, job.map).await.map_err(Failure::internal)?;
    print!("{}{}", summary(&context, &job), places_to_look(base, job.map));
    Ok(())
}

/// Follows a job to its end with a progress bar on stderr.
async fn wait(app: &App, caller: &Caller, id: Uuid) -> Result<JobRecord, AppError> {
    let style = ProgressStyle::with_template("{msg:<16} {bar:40} {percent:>3} %");
    let bar = ProgressBar::new(100).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let mut changes = app.job_changes();
    loop {
        changes.mark_unchanged();
        let job = app.job(caller, id).await?;
        bar.set_position(u64::from(job.progress));
        bar.set_message(job.stage.clone().unwrap_or_default());
        if job.state.is_final() {
            bar.finish_and_clear();
            return Ok(job);
        }
        // The channel closes when the app does; the next look at the job says how it ended.
        let _ = changes.changed().await;
    }
}

/// What was found, in a few lines.
fn summary(context: &MapContext, job: &JobRecord) -> String {
    let (analysis, semantic) = (&context.analysis, &context.semantic);
    let mut areas: BTreeMap<&str, (usize, f64)> = BTreeMap::new();
    for face in analysis.subdivision.faces() {
        let (count, area) = areas.entry(&semantic.label(face).name).or_default();
        *count += 1;
        *area += analysis.faces[face.index()].area;
    }
    let labels: Vec<String> =
        areas.iter().map(|(name, (count, area))| format!("{name}: {count} faces, {area:.0} m2")).collect();
    let degrees: Vec<String> =
        analysis.orientations.angles.iter().map(|angle| format!("{:.2}", angle.to_degrees())).collect();
    let cpu: f64 = job.stages.iter().map(|stage| stage.cpu_s).sum();
    format!(
        "{} x {} cells of {} m, analysed in {cpu:.1} CPU s\n\
         orientations {} degrees, {} lines, {} faces, {} edges, {} storage locations\n\
         {}\n",
        analysis.width,
        analysis.height,
        analysis.frame.resolution,
        degrees.join(", "),
        analysis.lines.len(),
        analysis.subdivision.face_count().saturating_sub(1),
        analysis.subdivision.edge_count(),
        context.layout.locations.len(),
        labels.join("; "),
    )
}

/// The addresses worth a first look.
fn places_to_look(base: &str, map: Uuid) -> String {
    let map = format!("{base}/v1/maps/{map}");
    format!(
        "\nDashboard      {base}/\n\
         Picture        {map}/semantic.png\n\
         Faces          {map}/collections/faces/items\n\
         Locations      {map}/collections/locations/items?f=csv\n\
         Categories     {map}/categories\n\
         API reference  {base}/docs\n"
    )
}
