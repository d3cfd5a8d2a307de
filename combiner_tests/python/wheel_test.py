"""`pip install .`: the backend packs what the build has made, and what pip installs of it can be imported."""
import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

top = pathlib.Path(__file__).resolve().parents[2]
build = pathlib.Path(os.environ["PYTHONPATH"]).parent
sys.path.append(str(top / "src/python/wheel"))
import ninebit_wheel  # noqa: E402

PROGRAM = "import ninebit; print(ninebit.Program('!!RC1.0\\nout.rgb = tex0;').evaluate(tex0=7).tolist(), ninebit.__file__)"


class Wheel(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.at = pathlib.Path(self.folder.name)
        self.name = ninebit_wheel.build_wheel(self.folder.name, {"build": str(build)})

    def test_it_has_what_its_record_says(self):
        self.assertEqual([file.name for file in self.at.iterdir()], [self.name])
        with zipfile.ZipFile(self.at / self.name) as wheel:
            names = set(wheel.namelist())
            lines = wheel.read(next(n for n in names if n.endswith("/RECORD"))).decode().splitlines()
            self.assertEqual({line.split(",")[0] for line in lines}, names)
            for name, digest, size in (line.split(",") for line in lines if not line.endswith(",,")):
                data = wheel.read(name)
                found = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                self.assertEqual((digest, int(size)), (f"sha256={found}", len(data)), name)
            package = {name.removeprefix("ninebit/") for name in names if name.startswith("ninebit/")}
        built = {file.name for file in (build / "python/ninebit").iterdir() if file.name != "__pycache__"}
        self.assertEqual(package, built)

    def test_pip_installs_it(self):
        pip = [sys.executable, "-m", "pip"]
        if subprocess.run([*pip, "--version"], capture_output=True, check=False).returncode != 0:
            self.skipTest("this Python has no pip")
        target = self.at / "installed"
        subprocess.run([*pip, "install", "--quiet", "--no-deps", "--no-index", "--target", target, top,
                        "--config-settings", f"build={build}"], check=True, env={**os.environ, "PYTHONPATH": ""})
        said = subprocess.run([sys.executable, "-c", PROGRAM], env={**os.environ, "PYTHONPATH": str(target)}, cwd=self.at,
                              capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.split("]")[0], "[7, 7, 7, 0")
        self.assertIn(str(target), said)

    def test_pip_installs_it_in_an_environment_without_a_network(self):
        made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", self.at / "venv"], capture_output=True,
                              text=True, check=False)
        if made.returncode != 0:
            self.skipTest(f"no virtual environment (Debian: python3-venv): {made.stdout or made.stderr}")
        python = self.at / "venv/bin/python"
        clean = {**os.environ, "PYTHONPATH": ""}
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", top, "--config-settings", f"build={build}"],
                       check=True, env=clean)
        said = subprocess.run([python, "-c", PROGRAM], env=clean, cwd=self.at, capture_output=True, text=True,
                              check=True).stdout
        self.assertEqual(said.split("]")[0], "[7, 7, 7, 0")
        self.assertIn(str(self.at / "venv"), said)
        shown = subprocess.run([python, "-m", "pip", "show", "ninebit"], env=clean, capture_output=True, text=True,
                               check=True).stdout
        self.assertIn("\nVersion: ", shown)

    def test_sources_are_packed(self):
        if not (top / ".git").exists():
            self.skipTest("not a clone")
        name = ninebit_wheel.build_sdist(self.folder.name)
        listed = subprocess.run(["tar", "-tzf", self.at / name], capture_output=True, text=True, check=True).stdout
        base = name.removesuffix(".tar.gz")
        expected = {f"{base}/{file}" for file in ("pyproject.toml", "PKG-INFO", "CMakeLists.txt", "src/python/wheel/ninebit_wheel.py")}
        self.assertEqual(expected - set(listed.splitlines()), set())


if __name__ == "__main__":
    unittest.main()
