"""The build backend of `pip install .` (PEP 517): CMake builds the package, and this module packs it. It needs no other
package, so that pip needs no network. The tools and libraries are those of `./dev build`.

Settings, by `pip install . --config-settings NAME=VALUE`: `build`, the build folder (build/wheel), which is built
again where it is there; `jobs`, how many processes compile."""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

TOP = pathlib.Path(__file__).resolve().parents[3]
ABI = f"cp{sys.version_info.major}{sys.version_info.minor}{getattr(sys, 'abiflags', '')}"
TAG = f"{ABI}-{ABI}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def project():
    """The fields of [project] in pyproject.toml that stand on one line, as Python 3.9 reads no TOML."""
    text = (TOP / "pyproject.toml").read_text(encoding="utf-8").split("[project]\n")[1].split("\n[")[0]
    fields = dict(re.findall(r'^([a-z-]+) = "(.*)"$', text, re.MULTILINE))
    lists = {name: re.findall(r'"(.*?)"', words) for name, words in re.findall(r"^([a-z-]+) = \[(.*)\]$", text, re.MULTILINE)}
    return fields, lists


def metadata():
    fields, lists = project()
    lines = ["Metadata-Version: 2.1", f"Name: {fields['name']}", f"Version: {fields['version']}",
             f"Summary: {fields['description']}", f"Requires-Python: {fields['requires-python']}",
             *(f"Requires-Dist: {one}" for one in lists["dependencies"]), "Description-Content-Type: text/markdown"]
    return "\n".join(lines) + "\n\n" + (TOP / "README.md").read_text(encoding="utf-8")


def run(*command):
    print(" ".join(map(str, command)), flush=True)
    try:
        subprocess.run([str(word) for word in command], cwd=TOP, check=True)
    except FileNotFoundError:
        sys.exit(f"ninebit: {command[0]} is not installed; `./dev packages build deb` installs what the build needs")
    except subprocess.CalledProcessError as error:
        sys.exit(f"ninebit: {command[0]} failed with status {error.returncode}; "
                 "`./dev packages build deb` installs what the build needs")


def build(settings):
    """Builds the package; gives its folder."""
    folder = TOP / (settings or {}).get("build", "build/wheel")
    if not (folder / "CMakeCache.txt").exists():
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        run("cmake", "-S", TOP, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
            "-DCMAKE_UNITY_BUILD_BATCH_SIZE=10", "-DNINEBIT_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}",
            "-DNINEBIT_BUILD_PROGRAM=OFF", "-DNINEBIT_BUILD_TESTS=OFF", "-DNINEBIT_INSTALL=OFF", "-DNINEBIT_SHARED=OFF")
    run("cmake", "--build", folder, "--target", "ninebit_python", "--parallel",
        (settings or {}).get("jobs", os.cpu_count() or 1))
    package = folder / "python" / "ninebit"
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / f"_combiner{suffix}").exists():
        sys.exit(f"ninebit: {folder} builds for another Python than {sys.executable}; expected a folder of this one, "
                 "or none: --config-settings build=FOLDER")
    return package


def write_metadata(folder):
    fields, _ = project()
    info = folder / f"{fields['name']}-{fields['version']}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(metadata(), encoding="utf-8")
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: ninebit_wheel\nRoot-Is-Purelib: false\nTag: {TAG}\n",
                                encoding="utf-8")
    shutil.copy(TOP / "LICENSE", info)
    return info


# What PEP 517 asks for.


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    return write_metadata(pathlib.Path(metadata_directory)).name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = build(config_settings)
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    fields, _ = project()
    name = f"{fields['name']}-{fields['version']}-{TAG}.whl"
    work = tempfile.TemporaryDirectory()
    info = write_metadata(pathlib.Path(work.name))
    files = [(f"ninebit/{file.name}", file) for file in sorted(package.iterdir())
             if file.suffix in (".py", ".pyi") or file.name.endswith(suffix) or
             file.name in ("py.typed", "ninebit_pictures.so")]
    files += [(f"{info.name}/{file.name}", file) for file in sorted(info.iterdir())]
    record = ""
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for at, file in files:
            data = file.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{at},sha256={digest},{len(data)}\n"
            entry = zipfile.ZipInfo.from_file(file.resolve(), at, strict_timestamps=False)
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
        wheel.writestr(f"{info.name}/RECORD", f"{record}{info.name}/RECORD,,\n")
    work.cleanup()
    return name


def build_sdist(sdist_directory, config_settings=None):
    fields, _ = project()
    base = f"{fields['name']}-{fields['version']}"
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=TOP, capture_output=True, text=True, check=False)
    if listed.returncode != 0:
        sys.exit(f"ninebit: the sources are packed from a clone; expected one at {TOP}")
    with tarfile.open(pathlib.Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in filter(None, listed.stdout.split("\0")):
            archive.add(TOP / file, f"{base}/{file}", recursive=False)
        info = pathlib.Path(sdist_directory) / "PKG-INFO"
        info.write_text(metadata(), encoding="utf-8")
        archive.add(info, f"{base}/PKG-INFO")
        info.unlink()
    return f"{base}.tar.gz"
