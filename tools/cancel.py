#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""How soon everything stops that is asked to: tools/cancel.py GABLE [NAME...] [--times N] [--within SECONDS].

Makes each example (models, a picture, tiles, a data set, a rule test) and interrupts it at random places of its work,
counted in seconds of the processor. Prints for each the worst time from the interrupt to the end of the process, and ends
with 1 where one is over 0.1 seconds, which are more on a machine that is slow. That time is the lesser of the clock's and
the processor's, of all threads together: on a busy machine the clock runs while the program waits for its turn. An interrupt
before the program is ready for one ends it at once.

What takes long is interrupted less often: each command gets --within seconds of the clock for its run and again for its
interrupts, but four of these at least. A run that is not over by then is ended, and interrupts fall into what was seen
of it; the line says so.
"""
import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import example_commands
from example_commands import ROOT

TICK = os.sysconf("SC_CLK_TCK")
FEWEST = 4
# Seconds of the processor that the work of slowness() takes on a machine on which 0.1 seconds are held.
WORK = 0.04


def slowness():
    """How many times longer than WORK the processor takes for a piece of work that goes through memory: more than once on a
    slow machine, and where others fill its caches."""
    chance = random.Random(1)
    numbers = [chance.random() for _ in range(1 << 18)]
    before = time.process_time()
    numbers.sort()
    return max(1.0, (time.process_time() - before) / WORK)


def processor_seconds(pid):
    """Of a process and the children that it has, in steps of a hundredth."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
    except OSError:
        return 0
    return sum(map(int, fields[11:15])) / TICK + sum(processor_seconds(child) for child in children)


def started(command):
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def whole_run(command, within):
    """Processor seconds of a run, and whether it came to its end within so many seconds of the clock."""
    with started(command) as process:
        end = time.perf_counter() + within
        while not has_ended(process.pid) and time.perf_counter() < end:
            time.sleep(0.01)
        complete = has_ended(process.pid)
        if not complete:
            process.kill()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if complete and process.returncode != 0:
        raise RuntimeError(f"'{' '.join(command)}' ended with {process.returncode}; run it to see why")
    return usage.ru_utime + usage.ru_stime, complete


def interrupted(command, after):
    """Seconds from an interrupt behind so much work to the end, by the clock and by the processor."""
    with started(command) as process:
        # What has ended is no longer running, and takes no interrupt.
        while processor_seconds(process.pid) < after and not has_ended(process.pid):
            time.sleep(0.001)
        before = processor_seconds(process.pid)
        begin = time.perf_counter()
        os.kill(process.pid, signal.SIGINT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return time.perf_counter() - begin, max(0.0, usage.ru_utime + usage.ru_stime - before)


def has_ended(pid):
    return Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0] == "Z"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gable", type=Path)
    parser.add_argument("names", nargs="*", metavar="NAME", help="examples; without, all")
    parser.add_argument("--times", type=int, default=20, help="interrupts of each command (default 20)")
    parser.add_argument("--within", type=float, default=60, metavar="SECONDS",
                        help="of the clock, for the run and for the interrupts of each command (default 60)")
    parser.add_argument("--kinds", nargs="+", choices=example_commands.KINDS, default=example_commands.KINDS,
                        help="of commands (default all)")
    parser.add_argument("--seed", type=int, default=0, help="of the random times (default 0)")
    parser.add_argument("--most", type=float, default=0.1, metavar="SECONDS")
    options = parser.parse_args()
    unknown = set(options.names) - set(example_commands.names())
    if unknown:
        parser.error(f"there is no example '{min(unknown)}'; './run example' lists them")
    # A shell starts what runs beside it with interrupts ignored, and gable leaves that as it is.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    chance = random.Random(options.seed)
    most = options.most * slowness()
    worst = (0.0, "")
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "out"
        for name in options.names or example_commands.names():
            out.mkdir()
            for kind, command in example_commands.commands(options.gable.resolve(), name, out, options.kinds):
                whole, complete = whole_run(command, options.within)
                late = []
                end = time.perf_counter() + options.within
                while len(late) < options.times and (len(late) < FEWEST or time.perf_counter() < end):
                    shutil.rmtree(out)
                    out.mkdir()
                    after = chance.uniform(0, whole)
                    clock, busy = interrupted(command, after)
                    late.append((min(clock, busy), clock, busy, after))
                least, clock, busy, after = max(late)
                worst = max(worst, (least, f"{name}, {kind}"))
                print(f"{name:18} {kind:9} {whole:6.2f} s; worst of {len(late)}: {least * 1000:4.0f} ms (clock {clock * 1000:.0f}, processor "
                      f"{busy * 1000:.0f}) after {after:.2f} s{'' if complete else ', of its beginning'}"
                      f"{'   TOO LATE' if least > most else ''}", flush=True)
            shutil.rmtree(out)
    print(f"worst: {worst[0] * 1000:.0f} ms of {most * 1000:.0f} ({worst[1]})")
    return 1 if worst[0] > most else 0


if __name__ == "__main__":
    sys.exit(main())
