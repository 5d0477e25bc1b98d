//! `meniscus network verify`: chosen throats of a network by direct simulation.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use super::exit::{BAD_INPUT, DONE, Failure, INTERRUPTED, SOLVER_FAILED, USAGE};
use super::output::{duration, say, tell};
use super::study_arguments::{CoresArguments, Engine, StudyFiles, StudyRunArguments};
use super::verify_arguments::VerifyArguments;
use super::{source, study_run};
use crate::study::folder::StudyFolder;
use crate::study::load::load;
use crate::study::results::{RunResult, results};
use crate::study::runs::plan as plan_runs;
use crate::verify::choose::{Choice, choose};
use crate::verify::fluids::Fluids;
use crate::verify::plan::{self, Plan, Planned, RUNS};
use crate::verify::report;
use crate::verify::results::{Row, Status, row};
use crate::verify::subdomain::Impossible;
use crate::verify::subject::{Subject, SubjectError};

/// Selects throats, writes the cases, runs them, and prints the results.
pub(crate) fn verify(arguments: &VerifyArguments) -> Result<u8, Failure> {
    let source = source::load_case(Some(&arguments.case), &arguments.overrides)?;
    let subject = Subject::new(&source.case).map_err(|error| match error {
        SubjectError::Setup(misfit) => source.refused(&misfit.into()).into(),
        other => Failure::new(BAD_INPUT, &other),
    })?;
    let choices: Vec<Choice> =
        arguments.throats.iter().map(|text| text.parse()).collect::<Result<_, _>>().map_err(Failure::with(USAGE))?;
    let chosen = choose(&subject, &choices, arguments.seed).map_err(Failure::with(USAGE))?;
    let mut planned: Vec<Planned> = chosen.into_iter().map(|one| Planned::new(&subject, one)).collect();
    let given = if arguments.alike { [None; 2] } else { subject.fluids };
    let fluids = Fluids { given, tension: subject.tension, invading: subject.invading, chip: subject.chip };
    let spacings: Vec<u32> = arguments.spacings.iter().map(|across| across.get()).collect();
    let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(format!("{}-verify", source.name)));
    let name = arguments.case.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let plan = Plan { throats: &planned, fluids: &fluids, spacings: &spacings, network: &name };
    let written = plan::write(&folder, &plan).map_err(Failure::with(USAGE))?;
    for (index, why) in written.refused {
        planned[index].subdomain = Err(Impossible::Case(why));
    }
    for one in &planned {
        if let Err(why) = &one.subdomain {
            tell(format_args!("throat {}: cut-out impossible: {why}", one.chosen.number));
        }
    }
    for kept in &written.kept {
        tell(format_args!("{} was changed by hand, and is run as is", kept.display()));
    }
    let subdomain = planned.iter().filter(|one| one.subdomain.is_ok()).count();
    tell(format_args!("{} throats, {subdomain} with a cut-out -> {}", planned.len(), folder.display()));
    let runs_in = folder.join(RUNS);
    let mut code = DONE;
    let mut found = Vec::new();
    if let Some(study) = written.study {
        if !arguments.only_write {
            code = study_run::run(&study_arguments(arguments, study.clone(), runs_in.clone()))?;
        }
        let loaded = load(&study).map_err(Failure::input)?;
        found = results(&plan_runs(&loaded).map_err(Failure::input)?, &StudyFolder::new(&runs_in));
    }
    if code == INTERRUPTED || arguments.only_write || arguments.execution.engine == Engine::Slurm && is_open(&found) {
        tell("the same command continues, and prints the results");
        return Ok(code);
    }
    let rows: Vec<Row> = planned.iter().map(|one| row(one, &fluids, &spacings, &found)).collect();
    let title = format!("Throats of {name} by direct simulation");
    let written = report::write(&folder, &subject, &rows, &spacings, &fluids, &title).map_err(Failure::with(USAGE))?;
    say(&title);
    if !rows.is_empty() {
        say(written.table.markdown().trim_end());
    }
    report::notes(&rows, &fluids, &spacings).iter().for_each(|note| say(format_args!("  note        {note}")));
    let time = rows.iter().map(|row| row.wall_time).sum::<f64>();
    say(format_args!("  all runs    {}", duration(time)));
    say(format_args!(
        "  replaced    {} of {} entry pressures, in {}",
        written.replaced,
        rows.len(),
        written.measured.display()
    ));
    say(format_args!("  page        {}", written.page.display()));
    say(format_args!("  table       {}", folder.join("verify.csv").display()));
    let failed = rows.iter().any(|row| matches!(row.status, Status::Failed(_)));
    Ok(if failed { SOLVER_FAILED } else { DONE })
}

fn is_open(results: &[RunResult]) -> bool {
    results.iter().any(|result| result.state.report().is_none())
}

fn study_arguments(arguments: &VerifyArguments, study: PathBuf, out: PathBuf) -> StudyRunArguments {
    StudyRunArguments {
        files: StudyFiles { studies: vec![study], out: Some(out) },
        cores: CoresArguments { threads: NonZeroUsize::MIN, jobs: arguments.threads },
        memory: None,
        execution: arguments.execution.clone(),
        index: None,
        worker: false,
        digest: None,
    }
}
