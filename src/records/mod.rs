//! What the service stores, as plain data. `store`, `jobs`, `app` and the edges pass these types to each other.

mod analysis;
mod audit;
mod correction;
mod job;
mod key;
mod map;
mod semantics;
mod tenant;

pub use analysis::{AnalysisRecord, AnalysisTicket};
pub use audit::AuditRecord;
pub use correction::{CorrectionId, CorrectionList, CorrectionRecord, NoCorrectionId};
pub use job::{JobFilter, JobRecord, JobState, StageReport};
pub use key::KeyRecord;
pub use map::{AlignmentRecord, MapPatch, MapRecord, NewMap};
pub use semantics::{CarryRecord, LostDecision, RuleSetRecord, SemanticsOrigin, SemanticsRecord};
pub use tenant::{NoTenant, Tenant};
