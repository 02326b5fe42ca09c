# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What bench/run measures, how, and the page that it writes.

A scene is one product that several programs make, each as a whole process: Gable at the head and at a base, hard-coded
loops, peers. They run in turn, so that what else the machine does meets all of them. A program of the benchmarks is run
for what it prints.
"""
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BENCH = ROOT / "bench"
# Peers are stopped after so many seconds, and the page says so.
LONGEST = 300


class Failed(RuntimeError):
    pass


@dataclass
class Builds:
    """Folders with programs; `base` is None where nothing is compared."""
    head: Path
    base: Path | None = None

    def gables(self):
        return [(name, folder / "gable") for name, folder in (("head", self.head), ("base", self.base)) if folder]


@dataclass
class Scene:
    """`commands`: by who makes it, a function from the output's folder to a command."""
    name: str
    what: str
    commands: dict = field(default_factory=dict)
    absent: list = field(default_factory=list)


def command_seconds(command, folder, seconds=None):
    """Clock and processor seconds of a command, and its memory at the peak in bytes."""
    with (folder / "said").open("w+b") as said:
        begin = time.perf_counter()
        with subprocess.Popen([str(c) for c in command], cwd=ROOT, stdout=said, stderr=said) as process:
            status, usage = waited(process, begin + seconds if seconds else None)
        wall = time.perf_counter() - begin
        if status is None:
            raise TimeoutError(f"stopped after {seconds} s")
        said.seek(0)
        if status != 0:
            told = said.read()[-600:].decode(errors="replace").strip()
            raise Failed(f"'{' '.join(map(str, command))}' ended with {status}:\n{told}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak": usage.ru_maxrss * 1024}


def waited(process, end):
    """The exit status and usage of a process, its children included; the status is None where it was stopped."""
    while end is not None:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, usage
        if time.perf_counter() > end:
            process.kill()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            return None, usage
        time.sleep(0.002)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage


def bytes_of(path):
    if path.is_dir():
        return sum(f.stat().st_size for f in path.rglob("*") if f.is_file())
    return path.stat().st_size if path.exists() else 0


def example(gable, name, model, *arguments):
    """As ./run makes an example."""
    return ["bash", "-c", '. tools/examples.sh; generate_example "$@"', "bash", gable, name, model, *arguments]


def peer(program, absent, title):
    """The path of a peer's program, or None and a line for the page."""
    path = os.environ.get("GABLE_" + program.upper().replace("-", "_")) or shutil.which(program)
    if not path:
        absent.append(f"{title}: `{program}` is not installed")
    return path


class Suite:
    """All scenes and programs, as far as the builds and the machine have them."""

    def __init__(self, builds, small=False):
        self.builds, self.small = builds, small
        self.loops = builds.head / "bench_loops"
        self.absent = []
        self.scenes = [*self.boxes(), *self.places()]
        self.programs = self.programs_of()

    def boxes(self):
        if not self.loops.exists():
            self.absent.append(f"scenes of boxes and the loops: there is no `bench_loops` in {self.builds.head.name}")
            return
        listed = subprocess.run([self.loops, "--list"], capture_output=True, text=True, check=True).stdout
        for name, rules, boxes in (line.split() for line in listed.splitlines()):
            if self.small and name != "W1":
                continue
            for extension in ("glb", "obj"):
                if extension == "obj" and name == "W3b":
                    continue
                yield self.box_scene(name, rules, int(boxes), extension)

    def box_scene(self, name, rules, boxes, extension):
        scene = Scene(f"{name} to {extension.upper()}", f"{boxes} boxes")

        def by_rules(gable):
            def command(folder):
                lots = folder / "lots.geojson"
                if not lots.exists():
                    subprocess.run([self.loops, "--lots", name, lots], check=True)
                return [gable, "generate", BENCH / "boxes" / rules, "--shapes", lots, "-o", folder / f"out.{extension}"]
            return command

        for who, gable in self.builds.gables():
            scene.commands[who] = by_rules(gable)
        scene.commands["loops"] = lambda folder: [self.loops, name, folder / f"out.{extension}"]
        if not self.small:
            self.add_peers(scene, name, extension)
        return scene

    def add_peers(self, scene, name, extension):
        if name == "W2":
            blender = peer("blender", self.absent, "Blender") if extension == "glb" else shutil.which("blender")
            if blender:
                # Its Python looks for its library beside the first `python3` of the path.
                scene.commands["Blender"] = lambda folder: [
                    "env", "PATH=/usr/bin:/bin", blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", BENCH / "peers/blender_w2.py", "--",
                    folder / f"out.{extension}"]
        if (name, extension) == ("W2", "obj"):
            if cfdg := peer("cfdg", self.absent, "Context Free"):
                scene.commands["Context Free (SVG)"] = lambda folder: [
                    cfdg, "-q", "-V", "-x", "0.0001", "-s", "20000", BENCH / "peers/w2.cfdg", folder / "out.svg"]
            if driver := os.environ.get("GABLE_STRUCTURE_SYNTH"):
                scene.commands["Structure Synth"] = lambda folder: [driver, BENCH / "peers/w2.es", folder / "out.obj"]
            else:
                self.absent.append("Structure Synth: Debian's program has no command line; GABLE_STRUCTURE_SYNTH names a driver of its "
                                   "core, which is called with bench/peers/w2.es and the OBJ to write")
        if (name, extension) == ("W1", "obj"):
            if openscad := peer("openscad", self.absent, "OpenSCAD"):
                scene.commands["OpenSCAD (STL)"] = lambda folder: [openscad, "-o", folder / "out.stl", BENCH / "peers/w1.scad"]

    def places(self):
        def made(make):
            return {who: (lambda folder, gable=gable: make(gable, folder)) for who, gable in self.builds.gables()}

        if self.small:
            yield Scene("rowhouse to GLB", "an example", made(lambda g, f: example(g, "rowhouse", f / "out.glb")))
            return
        for name in ("monaco", "town", "suburb"):
            yield Scene(f"{name} to GLB", "an example", made(lambda g, f, n=name: example(g, n, f / "out.glb")))
        for extension in ("obj", "ply"):
            yield Scene(f"monaco to {extension.upper()}", "an example",
                        made(lambda g, f, e=extension: example(g, "monaco", f / f"out.{e}")))
        if (self.builds.head / "gable-maps").exists():
            yield Scene("principality to GLB", "Monaco whole, from its map", made(lambda g, f: example(g, "principality", f / "out.glb")))
        else:
            self.absent.append("principality: built without libosmium")
        shapes = ["--shapes", "examples/monaco/buildings.geojson", "--cut-nested"]
        for more in ([], ["--compress"]):
            yield Scene(" ".join(["monaco to tiles", *more]), "an example",
                        made(lambda g, f, m=more: [g, "tiles", "examples/monaco/monaco.cga", *shapes, *m, "-o", f / "tiles"]))

    def programs_of(self):
        """Title, command; of the base only what both have."""
        out = []
        runs = "1" if self.small else "5"
        for who, gable in self.builds.gables():
            folder = gable.parent
            for title, *command in (("boxes", folder / "bench_boxes", "--runs", runs),
                                    ("rates", folder / "bench_rates", "--runs", runs, *(["--small"] if self.small else [])),
                                    ("progen3d", folder / "bench_progen3d", "--runs", runs)):
                if command[0].exists():
                    out.append((title, who, command))
                else:
                    self.absent.append(f"{title} at the {who}: there is no `{command[0].name}`")
            if self.small:
                continue
            out.append(("655 buildings", who, [sys.executable, BENCH / "quarter.py", gable, runs]))
            out.append(("a long street rule", who, [sys.executable, BENCH / "street.py", gable, runs]))
            if (folder.parent / "studio" / "index.html").exists():
                out.append(("keystrokes", who, [sys.executable, BENCH / "live.py", gable, "--keys", runs]))
            else:
                self.absent.append(f"keystrokes at the {who}: the studio's page is not built (`./run studio` builds it)")
        return out

    def measured(self, runs, only=(), tell=print):
        """What was measured, for the JSON file."""
        def wanted(name):
            return not only or any(o.lower() in name.lower() for o in only)

        scenes = [self.scene_figures(s, runs, tell) for s in self.scenes if wanted(s.name)]
        programs = []
        for title, who, command in self.programs:
            if wanted(title):
                done = subprocess.run([str(c) for c in command], cwd=ROOT, capture_output=True, text=True, check=False)
                if done.returncode != 0:
                    raise Failed(f"'{' '.join(map(str, command))}' ended with {done.returncode}:\n{(done.stdout + done.stderr)[-600:]}")
                programs.append({"title": title, "who": who, "lines": done.stdout.splitlines()})
                tell(f"{title}, {who}:\n{done.stdout}", end="")
        return {"scenes": scenes, "programs": programs, "absent": self.absent}

    @staticmethod
    def scene_figures(scene, runs, tell):
        rows = {who: [] for who in scene.commands}
        notes = {}
        sizes = {}
        with tempfile.TemporaryDirectory() as place:
            folders = {who: Path(place) / str(i) for i, who in enumerate(rows)}
            for folder in folders.values():
                folder.mkdir()
            for run in range(runs):
                for who, make in scene.commands.items():
                    own = who in ("head", "base", "loops")
                    # What takes seconds needs no median.
                    if who in notes or (not own and run >= 3) or (not own and run and rows[who][0]["wall"] > 20):
                        continue
                    for stale in folders[who].glob("out*"):
                        stale.unlink()
                    shutil.rmtree(folders[who] / "tiles", ignore_errors=True)
                    try:
                        rows[who].append(command_seconds(make(folders[who]), folders[who], None if own else LONGEST))
                    except TimeoutError as late:
                        notes[who] = str(late)
                        continue
                    except Failed as failure:
                        if own:
                            raise
                        notes[who] = "failed"
                        tell(f"{scene.name}: {failure}", flush=True)
                        continue
                    sizes[who] = sum(bytes_of(p) for p in [*folders[who].glob("out*"), *folders[who].glob("tiles")])
                    if sizes[who] == 0:
                        raise Failed(f"{scene.name}: '{who}' wrote nothing")
        out = {"name": scene.name, "what": scene.what, "by": {}}
        for who, all_rows in rows.items():
            if not all_rows:
                out["by"][who] = {"note": notes[who]}
                continue
            wall, cpu = [r["wall"] for r in all_rows], [r["cpu"] for r in all_rows]
            out["by"][who] = {"wall": statistics.median(wall), "worst": max(wall), "cpu": statistics.median(cpu),
                              "peak": max(r["peak"] for r in all_rows), "bytes": sizes[who], "runs": len(all_rows)}
            tell(f"{scene.name}: {who} {told(out['by'][who])}", flush=True)
        return out


def told(f):
    return (f"{f['wall']:.3f} s (worst {f['worst']:.3f}), processor {f['cpu']:.3f} s, {f['peak'] / 2**20:.0f} MiB, "
            f"{f['bytes'] / 1e6:.1f} MB")


def page(result):
    """The page of the results, in Markdown."""
    machine = result["machine"]
    chosen = [f"- Only what has one of these words in its name: {', '.join(result['only'])}"] if result.get("only") else []
    lines = ["# Rates", "",
             "Written by `bench/run`, which measures the programs of `bench/` and peers where they are installed; do not edit. "
             "Read [where the time goes](../design/performance.md) for what is behind the figures.", "",
             f"- Date: {result['date']}",
             f"- Commit: {result['commit']}" + (f", compared with {result['base']}" if result.get("base") else ""),
             f"- Machine: {machine['processor']}, {machine['cores']} cores, {machine['memory'] / 2**30:.0f} GiB; {machine['system']}",
             f"- Load of the machine at the start and at the end: {machine['load'][0]:.1f}, {machine['load'][1]:.1f}. Above "
             f"{machine['cores']}, compare processor seconds and ratios only.",
             *chosen, "", "## Whole processes", "",
             "From the start of the process to its end, the written file included; medians. The programs of a scene run in turn. "
             "`times the head` compares processor seconds.", "",
             "| scene | by | seconds | worst | processor | times the head | MiB | MB written |", "|---|---|---|---|---|---|---|---|"]
    for scene in result["scenes"]:
        head = scene["by"].get("head", {}).get("cpu")
        for who, f in scene["by"].items():
            if "note" in f:
                lines.append(f"| {scene['name']} | {who} | {f['note']} | | | | | |")
                continue
            ratio = f"{f['cpu'] / head:.2f}" if head else ""
            lines.append(f"| {scene['name']} | {who} | {f['wall']:.3f} | {f['worst']:.3f} | {f['cpu']:.3f} | {ratio} | "
                         f"{f['peak'] / 2**20:.0f} | {f['bytes'] / 1e6:.1f} |")
    lines += ["", "## Programs", "", "What the programs of `bench/` print.", ""]
    for title in dict.fromkeys(p["title"] for p in result["programs"]):
        lines += [f"### {title[0].upper() + title[1:]}", "", "```"]
        for p in result["programs"]:
            if p["title"] == title:
                lines += [f"{p['who']}: {line}".rstrip() for line in p["lines"]]
        lines += ["```", ""]
    if result["absent"]:
        lines += ["## Left out", "", *(f"- {a}" for a in dict.fromkeys(result["absent"])), ""]
    while lines[-1] == "":
        lines.pop()
    return "\n".join(lines) + "\n"
