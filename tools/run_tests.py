#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Runs ctest over a build folder with one line of progress and one summary.

    tools/run_tests.py BUILD [--jobs N] [--list] [--exclude-label REGEX] [FILTER...]

The last line is `N passed, N failed`, with `, N skipped` where tests were skipped. What failed prints
its output. Exit status 0 means that tests ran and none failed.
"""
import argparse
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as xml
from pathlib import Path

# Seconds after which a single test counts as hanging.
TIMEOUT = 600
# A test that takes longer than this is named in the summary.
SLOW = 20.0
DONE = re.compile(r"^ *(\d+)/(\d+) Test +#\d+: (\S+) \.* *(.*?) +([\d.]+) sec")


class Progress:
    """One line on a terminal that is overwritten; in a pipe a line every half minute."""

    def __init__(self):
        self.terminal = sys.stdout.isatty()
        self.last = time.monotonic()

    def show(self, text):
        now = time.monotonic()
        if self.terminal:
            sys.stdout.write("\r\x1b[K" + text[:100])
        elif now - self.last > 30:
            sys.stdout.write("  " + text + "\n")
            self.last = now
        sys.stdout.flush()

    def line(self, text):
        if self.terminal:
            sys.stdout.write("\r\x1b[K")
        print(text, flush=True)

    def clear(self):
        if self.terminal:
            sys.stdout.write("\r\x1b[K")
            sys.stdout.flush()


def command(options, junit):
    line = ["ctest", "--test-dir", options.build, "-j", str(options.jobs),
            "--timeout", str(options.timeout)]
    if options.exclude_label:
        line += ["-LE", options.exclude_label]
    if options.filters:
        line += ["-R", "|".join(f"({each})" for each in options.filters)]
    return line + (["-N"] if options.list else ["--output-junit", str(junit), "--no-tests=error"])


def run(options, junit):
    """Runs ctest; returns its exit status and those of its lines that were not about one test."""
    progress = Progress()
    rest = []
    failed = 0
    with subprocess.Popen(command(options, junit), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace") as ctest:
        for line in ctest.stdout:
            match = DONE.match(line)
            if not match:
                rest.append(line.rstrip())
                continue
            number, total, name, outcome, _ = match.groups()
            if "Failed" in outcome or "Exception" in outcome or "Timeout" in outcome:
                failed += 1
                progress.line(f"failed: {name}")
            progress.show(f"[{number}/{total}] {name}" + (f"  ({failed} failed)" if failed else ""))
    progress.clear()
    return ctest.returncode, rest


def results(junit):
    """(name, state, seconds, output) of each test; state is passed, failed or skipped."""
    for case in xml.parse(junit).getroot().iter("testcase"):
        skipped = case.find("skipped")
        reason = skipped.get("message", "") if skipped is not None else ""
        if case.get("status") == "run":
            state = "passed"
        elif case.get("status") == "disabled" or reason.startswith("SKIP_"):
            state = "skipped"
        else:
            # What could not be started at all is not skipped: it failed.
            state = "failed"
        output = (case.findtext("system-out") or "").strip()
        yield case.get("name"), state, float(case.get("time") or 0), output or reason


def summarise(cases, status, rest):
    by_state = {"passed": [], "failed": [], "skipped": []}
    for case in cases:
        by_state[case[1]].append(case)
    failures = len(by_state["failed"])
    for name, _, seconds, output in by_state["failed"]:
        print(f"\n--- {name} failed after {seconds:.1f} s\n{output}")
    if by_state["failed"]:
        print("\nFailed:")
        for name, *_ in by_state["failed"]:
            print("  " + name)
    if status != 0 and failures == 0:
        # The runner stopped by itself, or the test list could not be read.
        print("\n".join(rest[-40:]))
        failures = 1
    for name, _, seconds, _ in sorted(cases, key=lambda case: -case[2])[:5]:
        if seconds > SLOW:
            print(f"slow: {name} {seconds:.0f} s")
    last = f"{len(by_state['passed'])} passed, {failures} failed"
    if by_state["skipped"]:
        last += f", {len(by_state['skipped'])} skipped"
    print(last, flush=True)
    return 0 if failures == 0 and cases else 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=int, default=TIMEOUT, help="seconds for one test")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--exclude-label")
    parser.add_argument("filters", nargs="*")
    options = parser.parse_intermixed_args()
    if options.list:
        return subprocess.run(command(options, None), check=False).returncode
    junit = Path(options.build).resolve() / "tests.xml"
    junit.unlink(missing_ok=True)
    status, rest = run(options, junit)
    cases = list(results(junit)) if junit.exists() else []
    return summarise(cases, status, rest)


if __name__ == "__main__":
    sys.exit(main())
