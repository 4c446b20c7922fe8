//! What people choose: labels and rules, options of an analysis.

use stillage::options::RequestedOptions;
use stillage::views::rule_set::RuleSetBody;
use stillage_core::semantics::LabelId;

use super::check_refusal;

/// A rule set as JSON.
pub fn rule_set(bytes: &[u8]) {
    let Ok(body) = serde_json::from_slice::<RuleSetBody>(bytes) else { return };
    let draft = body.into_draft();
    draft.unreachable_rules().iter().for_each(check_refusal);
    match draft.check() {
        Ok(rules) => {
            let labels = || (0..rules.labels().len()).map(|label| LabelId(label as u8));
            labels().for_each(|one| {
                labels().for_each(|other| assert_eq!(rules.cogency(one, other), rules.cogency(other, one)));
            });
        }
        Err(problems) => problems.iter().for_each(check_refusal),
    }
}

/// The options of an analysis as JSON.
pub fn options(bytes: &[u8]) {
    let Ok(RequestedOptions(options)) = serde_json::from_slice(bytes) else { return };
    if let Err(problems) = options.check() {
        for problem in problems {
            check_refusal(&problem.message);
        }
    }
}
