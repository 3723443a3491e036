"""Gets Embree's library out of the `embreex` wheel and builds `embree_side` against it.

    python build.py --out DIR

prints the path of the program. Needs pip, a network or a cache of wheels, and g++ 9 or newer.
"""
import argparse
import os
import subprocess
import sys
import zipfile
from pathlib import Path

# The version that the declarations in embree_api.h were checked against.
WHEEL = "embreex==4.4.0.post1"
HERE = Path(__file__).resolve().parent


def wheel_in(out):
    """The wheel in `out`, downloaded if it is not there."""
    def there():
        return sorted(out.glob("embreex-4.4.0.post1-*.whl"))

    if not there():
        # pip's own words go to stderr: stdout has the program's path and nothing else.
        pip = [sys.executable, "-m", "pip", "download", WHEEL, "--no-deps", "--only-binary", ":all:", "-d", str(out)]
        subprocess.run(pip, check=True, stdout=sys.stderr)
    return there()[-1]


def library_in(wheel, out):
    """The path of libembree, unpacked beside the TBB that it finds through its own rpath."""
    with zipfile.ZipFile(wheel) as archive:
        names = [name for name in archive.namelist() if name.startswith("embreex.libs/lib")]
        archive.extractall(out, names)
    found = [name for name in names if Path(name).name.startswith("libembree")]
    if len(found) != 1:
        sys.exit(f"one libembree expected in {wheel.name}, found {found}")
    return out / found[0]


def build(library, out, compiler):
    """The path of the program; it finds the library beside itself."""
    program = out / "embree_side"
    # Without the last two flags std::sqrt keeps sample generation from being vectorised.
    flags = ["-std=c++17", "-O3", "-march=native", "-Wall", "-Wextra", "-pthread", "-fno-math-errno", "-fno-trapping-math"]
    rpath = f"-Wl,-rpath,$ORIGIN/{library.parent.relative_to(out)}"
    # The library's own TBB is looked up beside it, at run time and by the linker alike.
    link = [str(library), rpath, f"-Wl,-rpath-link,{library.parent}"]
    subprocess.run([compiler, *flags, str(HERE / "embree_side.cpp"), "-o", str(program), *link], check=True)
    return program


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="a folder for the wheel, the library and the program")
    parser.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    print(build(library_in(wheel_in(out), out), out, arguments.compiler))


if __name__ == "__main__":
    main()
