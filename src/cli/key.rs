//! `stillage key`: API keys, on a database that a service may be using.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, Subcommand};
use jiff::Timestamp;

use super::storage::DatabaseArgs;
use crate::access::{ApiKey, Expiry, KeySecret, KeySecretError, Scope};
use crate::config::Config;
use crate::records::{KeyRecord, Tenant};
use crate::store::{self, Keys, StoreError, now};

/// Makes, lists and ends API keys. A running service (`serve --keys required`) knows of it at once.
#[derive(Debug, Clone, Args)]
pub(super) struct KeyArgs {
    #[command(subcommand)]
    command: KeyCommand,
}

#[derive(Debug, Clone, Subcommand)]
enum KeyCommand {
    /// Makes a key and prints it. It is not shown again.
    Create(CreateArgs),
    /// Lists the keys, without their secrets.
    List(ListArgs),
    /// Ends a key: within a second it opens nothing any more.
    Revoke(RevokeArgs),
}

#[derive(Debug, Clone, Args)]
struct CreateArgs {
    #[command(flatten)]
    database: DatabaseArgs,
    /// File of the secret that keys are hashed with; made where it is missing. `key-secret` in the data folder when absent. A
    /// shared database needs one that all processes read.
    #[arg(long, env = "STILLAGE_KEY_SECRET_FILE", value_name = "FILE")]
    key_secret_file: Option<PathBuf>,
    /// For whom it acts: it sees the maps of this tenant and no others. Those of a service without keys are of `local`.
    #[arg(long, value_name = "NAME")]
    tenant: Tenant,
    /// What it is good for: `read`, `write`, `admin` (the log of changes), `metrics`, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "read,write", value_name = "SCOPES")]
    scopes: Vec<Scope>,
    /// When it ends: `90d`, `12h`, a day such as `2027-03-31`, or `never`.
    #[arg(long, default_value = "90d", value_name = "END")]
    expires: Expiry,
    /// What people call it, such as the robot or program that has it.
    #[arg(long, default_value = "", value_name = "NAME")]
    name: String,
}

#[derive(Debug, Clone, Args)]
struct ListArgs {
    #[command(flatten)]
    database: DatabaseArgs,
    /// Only those of this tenant.
    #[arg(long, value_name = "NAME")]
    tenant: Option<Tenant>,
}

#[derive(Debug, Clone, Args)]
struct RevokeArgs {
    #[command(flatten)]
    database: DatabaseArgs,
    /// Its id: the second part of the key, as `key list` shows it. The whole key does, too.
    #[arg(value_name = "ID")]
    id: String,
}

/// Why it could not be done.
#[derive(Debug, thiserror::Error)]
pub(super) enum KeyError {
    /// The store says no.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The file of the secret.
    #[error(transparent)]
    Secret(#[from] KeySecretError),
    /// It would be over before it begins.
    #[error("--expires: {0} is over already")]
    Over(Timestamp),
    /// Nothing to revoke.
    #[error("there is no key {0}: `stillage key list` shows which there are")]
    Unknown(String),
    /// Threads, random bytes, standard output.
    #[error("the system refused: {0}")]
    System(#[from] io::Error),
}

/// Runs the command.
pub(super) fn run(args: &KeyArgs) -> Result<(), KeyError> {
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(async {
        match &args.command {
            KeyCommand::Create(args) => create(args).await,
            KeyCommand::List(args) => list(args).await,
            KeyCommand::Revoke(args) => revoke(args).await,
        }
    })
}

async fn open(database: &DatabaseArgs) -> Result<Box<dyn Keys>, StoreError> {
    store::open_keys(&database.address()).await
}

async fn create(args: &CreateArgs) -> Result<(), KeyError> {
    let created = now();
    let expires = args.expires.of_key_made(created);
    if let Some(end) = expires.filter(|end| *end <= created) {
        return Err(KeyError::Over(end));
    }
    // First the database, which makes the folder.
    let keys = open(&args.database).await?;
    let config = Config { key_secret_file: args.key_secret_file.clone(), ..args.database.config() };
    let secret = KeySecret::read_or_make(&config.key_secret_path()?)?;
    let key = ApiKey::generate()?;
    let record = KeyRecord {
        id: key.id().to_owned(),
        tenant: args.tenant.clone(),
        name: args.name.clone(),
        scopes: args.scopes.iter().copied().collect(),
        created,
        expires,
        revoked: None,
    };
    keys.create_key(&record, &key.hash(&secret)).await?;
    writeln!(
        io::stderr(),
        "a key of {} for {}, {}; it is not shown again:",
        record.tenant,
        record.scopes,
        end(&record)
    )?;
    Ok(writeln!(io::stdout(), "{}", key.reveal())?)
}

async fn list(args: &ListArgs) -> Result<(), KeyError> {
    let mut out = io::stdout();
    writeln!(out, "{:16}  {:12}  {:24}  {:26}  name", "id", "tenant", "scopes", "state")?;
    for key in open(&args.database).await?.keys(args.tenant.as_ref()).await? {
        writeln!(
            out,
            "{:16}  {:12}  {:24}  {:26}  {}",
            key.id,
            key.tenant.as_str(),
            key.scopes.to_string(),
            end(&key),
            key.name
        )?;
    }
    Ok(())
}

async fn revoke(args: &RevokeArgs) -> Result<(), KeyError> {
    let whole = ApiKey::read(&args.id);
    let id = whole.as_ref().map_or(args.id.as_str(), ApiKey::id);
    let revoked = open(&args.database).await?.revoke_key(id, now()).await?;
    let key = revoked.ok_or_else(|| KeyError::Unknown(id.to_owned()))?;
    Ok(writeln!(io::stdout(), "{} of {}: {}", key.id, key.tenant, end(&key))?)
}

/// When a key ends, in a few words.
fn end(key: &KeyRecord) -> String {
    let second = |time: Timestamp| time.strftime("%Y-%m-%dT%H:%M:%SZ").to_string();
    match (key.revoked, key.expires) {
        (Some(time), _) => format!("revoked {}", second(time)),
        (None, Some(time)) if time <= now() => format!("ended {}", second(time)),
        (None, Some(time)) => format!("until {}", second(time)),
        (None, None) => "without an end".to_owned(),
    }
}
