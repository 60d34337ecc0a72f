"""pip install . : CMake builds the compiled part (Debian: scripts/setup.sh pybind11-dev python3-dev python3-numpy python3-setuptools)."""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        build = pathlib.Path(self.build_temp).resolve() / "cmake"
        subprocess.run(
            ["cmake", "-S", root, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DSIGNORINI_TOGETHER=ON", "-DSIGNORINI_TESTS=OFF",
             "-DSIGNORINI_PYTHON=ON", f"-DPYTHON_EXECUTABLE={sys.executable}"],
            check=True)
        subprocess.run(["cmake", "--build", build, "-t", "_signorini", "-j", str(os.cpu_count())], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(next((build / "python" / "signorini").glob("_signorini*.so")).read_bytes())


version = re.search(r"project\(signorini VERSION (\S+)", (root / "CMakeLists.txt").read_text()).group(1)
setup(version=version, ext_modules=[Extension("signorini._signorini", [])], cmdclass={"build_ext": CMakeBuild})
