# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""A run of the program in the background, in a folder of its own that goes with it. Needs no Blender."""
import json
import os
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass, field

from . import command, messages

# Exit statuses of the program (its help has them): done, and stopped by a limit, what was made being written.
DONE, LIMIT = 0, 4
# What ends by itself once it is asked to.
PATIENCE = 3.0
# Between looks at a run that is waited for.
PAUSE = 0.02
# Bytes of UTF-8 that the name of a custom property of Blender has at most.
MOST_NAME = 63


@dataclass
class Outcome:
    ok: bool
    model: str = ""
    statistics: dict = field(default_factory=dict)
    messages: list = field(default_factory=list)

    def report_sums(self):
        """{name of a custom property: the sum of a report}, of reports of numbers."""
        return {property_name(f"report {key}"): float(report["sum"])
                for key, report in self.statistics.get("reports", {}).items()
                if isinstance(report.get("sum"), (int, float))}


def property_name(text):
    """The beginning of a text that Blender takes as a name, in whole characters."""
    return text.encode("utf-8", "replace")[:MOST_NAME].decode("utf-8", "ignore")


def ask(line, seconds):
    """Runs a command that answers with an object of JSON: (the object or None, messages)."""
    try:
        done = subprocess.run(line, capture_output=True, encoding="utf-8", errors="replace", timeout=seconds,
                              stdin=subprocess.DEVNULL)
    except (OSError, subprocess.SubprocessError) as error:
        return None, [messages.Message("error", f"gable does not answer: {error}",
                                       "look at the program in the add-on's preferences")]
    try:
        answer = json.loads(done.stdout)
    except ValueError:
        answer = None
    if isinstance(answer, dict):
        return answer, messages.of_json(answer.get("diagnostics", []))
    found = messages.of_text(done.stderr)
    return None, found or [messages.Message("error", f"gable ended with status {done.returncode} and no answer",
                                            "run it in a terminal to see why")]


def complete(work):
    """Steps until the work is done; cancels it where a step raises."""
    try:
        while not work.step():
            time.sleep(PAUSE)
    except BaseException:
        work.cancel()
        raise


class Job:
    """Starts at once. Call poll() until it gives an Outcome, then close()."""

    def __init__(self, program, wishes, lots):
        self.folder = tempfile.mkdtemp(prefix="gable-")
        self.started = time.monotonic()
        self.wishes = wishes
        self._model = self._path("model.glb")
        self._statistics = self._path("statistics.json")
        self._said = self._path("said.txt")
        self._process = None
        shapes = self._path("lots.glb")
        try:
            with open(shapes, "wb") as file:
                file.write(lots)
            with open(self._said, "wb") as said:
                self._process = subprocess.Popen(
                    command.generate(program, wishes, shapes, self._model, self._statistics), stdout=said,
                    stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        except OSError:
            self.close()
            raise

    def _path(self, name):
        return os.path.join(self.folder, name)

    def seconds(self):
        return time.monotonic() - self.started

    def poll(self):
        """None while it runs."""
        status = self._process.poll()
        if status is None:
            return None
        with open(self._said, encoding="utf-8", errors="replace") as said:
            found = messages.of_text(said.read())
        ok = status in (DONE, LIMIT) and os.path.isfile(self._model)
        if not ok and not any(m.severity == "error" for m in found):
            found.append(messages.Message("error", f"gable ended with status {status} and no model",
                                          "run it in a terminal to see why"))
        return Outcome(ok, self._model if ok else "", self._read_statistics(), messages.ordered(found))

    def _read_statistics(self):
        try:
            with open(self._statistics, encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            return {}

    def close(self):
        """Ends the program where it still runs, and removes what it wrote."""
        if self._process and self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
