"""Truth on scanlines against Embree's packets: the same receivers, as many samples, taking turns.

    python tests/peers/embree/compare.py --embree DIR/embree_side --models MODELS [CASE ...]

MODELS holds `atrium.obj` and `crytek_sponza.obj`; cases are those of the bench target `truth`. Embree
runs with and without its coherent flag and the better median counts. Only the standard library.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]


def bench():
    """The bench target's program."""
    made = subprocess.run(
        ["cargo", "bench", "-p", "umbrage-reference", "--bench", "truth", "--no-run", "--message-format", "json"],
        cwd=REPOSITORY, check=True, stdout=subprocess.PIPE, text=True)
    lines = [json.loads(line) for line in made.stdout.splitlines()]
    return next(line["executable"] for line in lines if line.get("executable") and line["target"]["name"] == "truth")


class Side:
    """A program that does one round for each line it is sent."""

    def __init__(self, command):
        self.process = subprocess.Popen(list(map(str, command)), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, word):
        self.process.stdin.write(word + "\n")
        self.process.stdin.flush()
        while not (line := self.process.stdout.readline()).startswith("{\"seconds"):
            if not line:
                raise SystemExit(f"{self.process.args[0]} ended early")
        return json.loads(line)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def compare(case, program, options, folder):
    exported = folder / "case.bin"
    common = [program, case, "--models", options.models, "--size", options.size, "--samples", options.samples]
    subprocess.run([*common, "--export", exported], check=True, stdout=subprocess.DEVNULL)
    ours = Side([*common, "--serve", "--method", options.method])
    theirs = Side([options.embree, exported, "--threads", "2"])
    words = ["shadow", "shadow incoherent", "camera"]
    took = {word: [] for word in ["truth", "our camera", *words]}
    for _ in range(options.rounds):
        took["truth"].append(ours.ask("truth")["seconds"])
        took["our camera"].append(ours.ask("camera")["seconds"])
        for word in words:
            answer = theirs.ask(word)
            took[word].append(answer["seconds"])
            if word == "shadow":
                rays = answer["rays"]
    ours.close()
    theirs.close()
    median = {word: statistics.median(seconds) for word, seconds in took.items()}
    embree = min(median["shadow"], median["shadow incoherent"])
    print(f"| {case} | {median['truth']:.3f} | {embree:.3f} | {rays / embree / 1e6:.0f} | "
          f"**{embree / median['truth']:.1f}** | {median['our camera']:.3f} | {median['camera']:.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", nargs="*", default=["sponza-sun", "atrium-sun", "atrium-rect", "atrium4-sun", "atrium4-rect"])
    parser.add_argument("--embree", type=Path, required=True, help="the program that build.py makes")
    parser.add_argument("--models", type=Path, required=True)
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--samples", default="1024")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--method", default="scanlines")
    options = parser.parse_args()
    program = bench()
    print("| case | truth, s | Embree, s | Mrays/s | ratio | camera rays, s | Embree single, s |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for case in options.case:
            compare(case, program, options, Path(folder))


if __name__ == "__main__":
    main()
