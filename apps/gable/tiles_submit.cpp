// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable tiles submit: scripts that run the jobs of a plan, and run. They lie in the plan, so that
// who wants other options changes and starts them by hand; the merge removes them with it, and the
// logs.

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "answer.h"
#include "tiles.h"

namespace {

/// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

struct Place {
  std::string program, folder, plan;
};

Place placeOf(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  Place out;
  out.program = fs::read_symlink("/proc/self/exe", error).string();
  out.folder = fs::absolute(folder, error).string();
  out.plan = out.folder + "plan/";
  return out;
}

std::string head(const char* what) {
  return std::string("#!/bin/sh\n# Written by gable tiles submit: ") + what + "\n";
}

/// Tries jobs $first to $last. An exit status of 1 or 2 is a mistake that stays.
std::string tryJobs(const Place& at, uint64_t tries) {
  return "try=1\n"
         "until " +
         quoted(at.program) + " tiles job " + quoted(at.folder) +
         " \"$first-$last\" --threads \"${SLURM_CPUS_PER_TASK:-1}\"; do\n"
         "  status=$?\n"
         "  if [ $status -le 2 ] || [ $try -ge " +
         std::to_string(tries) +
         " ]; then exit $status; fi\n"
         "  try=$((try + 1))\n"
         "  sleep $((try * 5))\n"
         "done\n";
}

std::string mergeScript(const Place& at) {
  return head("joins what the jobs have made, and makes what is missing.") + "exec " +
         quoted(at.program) + " tiles merge " + quoted(at.folder) + " --mend\n";
}

/// A Slurm array may have 1001 tasks unless its administrators say otherwise, so a task has several
/// jobs in large plans.
std::string slurmArray(const Place& at, uint64_t jobs, uint64_t each, uint64_t tries) {
  return head("one task of the job array.") + "first=$((SLURM_ARRAY_TASK_ID * " +
         std::to_string(each) + "))\nlast=$((first + " + std::to_string(each - 1) +
         "))\nif [ $last -ge " + std::to_string(jobs) +
         " ]; then last=" + std::to_string(jobs - 1) + "; fi\n" + tryJobs(at, tries);
}

/// Slurm reads % in the names of logs: %% is a plain one, %a the number of the task.
std::string forSlurm(const std::string& path) {
  std::string out;
  for (const char c : path) out += c == '%' ? std::string("%%") : std::string(1, c);
  return out;
}

std::string slurmSubmit(const Place& at, uint64_t tasks, const std::string& options) {
  const std::string common = "sbatch --parsable --requeue " + options + " --job-name=";
  return head("hands the jobs to Slurm; the merge waits for all, failed ones too.") +
         "set -e\narray=$(" + common + "gable-tiles --array=0-" + std::to_string(tasks - 1) +
         " --output=" + quoted(forSlurm(at.plan) + "logs/%a.txt") + " " +
         quoted(at.plan + "array.sh") +
         ")\n# Behind it stands the cluster, where there are "
         "several.\narray=${array%%;*}\nmerge=$(" +
         common + "gable-merge --dependency=\"afterany:$array\" --output=" +
         quoted(forSlurm(at.plan) + "logs/merge.txt") + " " + quoted(at.plan + "merge.sh") +
         ")\necho \"jobs $array, merge $merge; until that is done, logs in \"" +
         quoted(at.plan + "logs") + "\n";
}

std::string parallelRun(const Place& at, uint64_t jobs, uint64_t tries,
                        const std::string& options) {
  // GNU parallel would read braces in paths, so those go to the jobs as variables.
  return head("runs the jobs with GNU parallel, then the merge.") +
         "export GABLE_PROGRAM=" + quoted(at.program) + " GABLE_TILES=" + quoted(at.folder) +
         "\nseq 0 " + std::to_string(jobs - 1) +
         " | parallel --will-cite --env GABLE_PROGRAM --env GABLE_TILES --retries " +
         std::to_string(tries) + " --joblog " + quoted(at.plan + "logs/jobs.txt") + " " + options +
         " '\"$GABLE_PROGRAM\" tiles job \"$GABLE_TILES\" {} --threads 1'\nexec " +
         quoted(at.plan + "merge.sh") + "\n";
}

bool isInstalled(const char* program) {
  const std::string command = std::string("command -v ") + program + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

int writeScript(const std::string& path, const std::string& text) {
  if (const int status = writeText(path, text)) return status;
  std::error_code error;
  std::filesystem::permissions(path, std::filesystem::perms(0755), error);
  return kExitDone;
}

}  // namespace

int runTilesSubmit(const SubmitArguments& arguments) {
  if (!arguments.slurm && !arguments.parallel) {
    return fail(kExitUsage, "say how to run the jobs: --slurm or --parallel");
  }
  const std::string folder = asFolder(arguments.folder);
  const gable::TilePlan plan = gable::TilePlan::load(folder);
  print(plan.diagnostics());
  if (!plan.ok()) return kExitFile;
  const char* const program = arguments.slurm ? "sbatch" : "parallel";
  if (!arguments.dry && !isInstalled(program)) {
    return fail(kExitFile, std::string("the program ") + program +
                               " is not installed; install the package " +
                               (arguments.slurm ? "slurm-client" : "parallel"));
  }
  const Place at = placeOf(folder);
  std::error_code error;
  std::filesystem::create_directories(at.plan + "logs", error);
  constexpr uint64_t kMostTasks = 1000;
  const uint64_t each = (plan.jobs() + kMostTasks - 1) / kMostTasks;
  const uint64_t tasks = (plan.jobs() + each - 1) / each;
  const std::string array = slurmArray(at, plan.jobs(), each, arguments.tries);
  const std::string submit = arguments.slurm
                                 ? slurmSubmit(at, tasks, arguments.options)
                                 : parallelRun(at, plan.jobs(), arguments.tries, arguments.options);
  const std::string run = at.plan + "submit.sh";
  for (const auto& [path, text] :
       {std::pair{at.plan + "array.sh", array}, std::pair{at.plan + "merge.sh", mergeScript(at)},
        std::pair{run, submit}}) {
    if (const int status = writeScript(path, text)) return status;
  }
  if (arguments.dry) {
    put(run + "\n");
    answer().text("script", run);
    return kExitDone;
  }
  // With --json the standard output is the answer alone.
  const std::string command = quoted(run) + (terminal().json ? " >&2" : "");
  const int status = std::system(command.c_str());
  if (status == 0) return kExitDone;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kExitWrong;
}
