#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What a keystroke costs the server of the studio: live.py GABLE [SCENE...] [--keys N] [--pause SECONDS] [--json FILE].

Starts `gable studio` on a copy of the examples and asks for models as its page does, each with another number in one
rule. Prints for each scene, over the keystrokes after the first model: seconds until the whole answer is there, seconds
of the processor that the server took until then, of it deriving, the bytes of the answer, and the share of shapes that was taken
over from the model before. Each comes a second after the answer before, as a person sees one before typing on; --pause
0 has them at once. On a busy machine the seconds of the processor count. Run from the repository's root.
"""
import argparse
import http.client
import json
import os
import shutil
import statistics
import struct
import subprocess
import tempfile
import time
import urllib.parse
from pathlib import Path

TOWN = {"main": "town/town.cga", "ask": {"seed": 1, "shapes": {"lot": [1000, 1000]}, "limits": {"seconds": 400}}}
PITCH = {"edited": "suburb_house/suburb_house.cga", "text": "attr pitch = {}", "was": "34",
         "typed": ["35", "36", "37", "38", "39", "40", "41", "42"]}
# The file that the page shows, the file of the edit, a text in it with {} for the number, the number that it has, those
# that are typed one after the other, and what is asked for besides.
SCENES = {
    "house": PITCH | {"main": "suburb_house/suburb_house.cga", "ask": {"shapes": {"lot": [20, 30]}}},
    "apartments": {"main": "haussmann/haussmann.cga", "edited": "haussmann/haussmann.cga", "text": "const upperRise = {}",
                   "was": "1.0", "typed": ["1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8"],
                   "ask": {"shapes": {"file": "haussmann/buildings.geojson", "only": [0]}}},
    "town": TOWN | PITCH,
    "lamps": TOWN | {"edited": "town/town.cga", "text": "s(0.22, 0.{}, 0.22) center(xz) primitiveCylinder(6) Iron", "was": "8",
                     "typed": ["85", "7", "75", "6", "65", "9", "95", "55"]},
}


class Studio:
    """`gable studio` on a folder, for a page of its own."""

    def __init__(self, gable, folder):
        self.process = subprocess.Popen([gable, "studio", str(folder), "--port", "0"], stdout=subprocess.PIPE, text=True)
        address = urllib.parse.urlparse(self.process.stdout.readline().strip())
        if not address.port:
            self.stop()
            raise RuntimeError(f"'{gable} studio' printed no address")
        self.port = address.port
        self.token = urllib.parse.parse_qs(address.query)["token"][0]
        self.known = 0

    def stop(self):
        self.process.terminate()
        self.process.wait()

    def cpu(self):
        """Seconds of the processor that it has taken."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def derive(self, request):
        """The head of the answer, and its size in bytes; what it leaves out the page before has."""
        request = request | {"known": self.known}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=600)
        try:
            connection.request("POST", "/api/derive", json.dumps(request), {"X-Gable-Token": self.token})
            answer = connection.getresponse()
            body = answer.read()
        finally:
            connection.close()
        if answer.status != 200:
            raise RuntimeError(f"the studio answered {answer.status}: {body[:200]!r}")
        length, = struct.unpack_from("<I", body, 4)
        head = json.loads(body[8:8 + length])
        self.known = head.get("derivation", 0)
        return head, len(body)


def request_of(scene, folder, number):
    """What the page asks for with that number in the rule."""
    texts = {name: (folder / name).read_text(encoding="utf-8") for name in {scene["main"], scene["edited"]}}
    before = scene["text"].format(scene["was"])
    if texts[scene["edited"]].count(before) != 1:
        raise RuntimeError(f"'{before}' is not once in {scene['edited']}; correct SCENES in bench/live.py")
    texts[scene["edited"]] = texts[scene["edited"]].replace(before, scene["text"].format(number))
    main = texts.pop(scene["main"])
    return {"page": "live", "file": scene["main"], "text": main, "overlay": texts, "start": "", "seed": 0,
            "attributes": {}} | scene["ask"]


def measured(gable, scene, keys, pause):
    """Of each keystroke: seconds, seconds of the processor, seconds of deriving, bytes, share taken over."""
    rows = []
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "examples"
        shutil.copytree("examples", folder, ignore=shutil.ignore_patterns("*.png", "*.pbf"))
        studio = Studio(gable, folder)
        try:
            for number in [scene["was"], *scene["typed"][:keys]]:
                request = request_of(scene, folder, number)
                busy, begin = studio.cpu(), time.perf_counter()
                head, size = studio.derive(request)
                seconds = time.perf_counter() - begin
                if head["end"] != "done":
                    raise RuntimeError(f"the derivation ended '{head['end']}': {head['diagnostics'][:1]}")
                stats = head["stats"]
                rows.append({"seconds": seconds, "cpu": studio.cpu() - busy, "derive": stats["seconds"]["derive"], "bytes": size,
                             "kept": stats.get("recalled", 0) / max(1, stats["shapes"])})
                time.sleep(pause)
        finally:
            studio.stop()
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gable")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=" ".join(SCENES))
    parser.add_argument("--keys", type=int, default=5)
    parser.add_argument("--pause", type=float, default=1, metavar="SECONDS")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    unknown = set(options.scenes) - set(SCENES)
    if unknown:
        parser.error(f"there is no scene '{min(unknown)}'; there are {', '.join(SCENES)}")
    told = {}
    for name in options.scenes or SCENES:
        first, *rows = measured(options.gable, SCENES[name], options.keys, options.pause)
        middle = {key: statistics.median(r[key] for r in rows) for key in first}
        told[name] = {"first": first, "median": middle, "worst": max(r["seconds"] for r in rows)}
        print(f"{name:10} first {first['seconds']:6.2f} s; a keystroke {middle['seconds']:6.3f} s (worst {told[name]['worst']:.3f}), "
              f"processor {middle['cpu']:.2f} s, deriving {middle['derive']:.3f} s, {middle['bytes'] / 1e6:.1f} MB, "
              f"{100 * middle['kept']:.0f} % kept", flush=True)
    if options.json:
        options.json.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
