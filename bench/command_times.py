# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The seconds that a command takes, from its start to its end."""
import subprocess
import time


def seconds_of(command, runs, **options):
    """Of each of several runs; the command must succeed."""
    seconds = []
    for _ in range(runs):
        begin = time.perf_counter()
        subprocess.run(command, check=True, **options)
        seconds.append(time.perf_counter() - begin)
    return seconds


def told(seconds):
    return ("seconds: " + " ".join(f"{s:.2f}" for s in seconds) + f"; median {sorted(seconds)[len(seconds) // 2]:.2f}, "
            f"worst {max(seconds):.2f}")
