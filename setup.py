"""pip install . : the compiled part is linked with the library that is installed (libsignorini-dev, or cmake --install), if that was built
with these headers; else CMake compiles the library, too, which takes some ten minutes of processor time. pip -v shows which.
Debian: scripts/setup.sh pybind11-dev python3-dev python3-numpy python3-setuptools."""
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
        made = self.linked(build / "linked") or self.compiled(build / "whole")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(next(made.glob("_signorini*.so")).read_bytes())

    def linked(self, build):
        """The folder of the module, linked with the installed library; None where there is none that fits."""
        configured = subprocess.run(
            ["cmake", "-S", root / "python", "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DPYTHON_EXECUTABLE={sys.executable}"],
            capture_output=True, text=True)
        if configured.returncode != 0:
            print("signorini: no installed library fits; it is compiled, some ten minutes of processor time\n"
                  + configured.stderr, file=sys.stderr, flush=True)
            return None
        print("signorini: linked with the installed library", file=sys.stderr, flush=True)
        subprocess.run(["cmake", "--build", build], check=True)
        return build / "signorini"

    def compiled(self, build):
        subprocess.run(
            ["cmake", "-S", root, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DSIGNORINI_TOGETHER=ON", "-DSIGNORINI_TESTS=OFF",
             "-DSIGNORINI_PYTHON=ON", f"-DPYTHON_EXECUTABLE={sys.executable}"],
            check=True)
        subprocess.run(["cmake", "--build", build, "-t", "_signorini", "-j", str(os.cpu_count())], check=True)
        return build / "python" / "signorini"


version = re.search(r"project\(signorini VERSION (\S+)", (root / "CMakeLists.txt").read_text()).group(1)
setup(version=version, ext_modules=[Extension("signorini._signorini", [])], cmdclass={"build_ext": CMakeBuild})
