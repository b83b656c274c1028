"""The C++ has no memory errors on random input."""

import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).parent
CPP = HERE.parents[2] / "cpp/render"
RENDERER = (
    "bvh", "cpu_dispatch", "draw", "geometry", "kernel", "light", "mesh_lod", "ray_targets", "renderer", "transform"
)  # fmt: skip
COMPILER = next((path for name in ("g++", "clang++") if (path := shutil.which(name))), None)


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason="g++ and clang++ are not installed")
@pytest.mark.skipif(not CPP.is_dir(), reason="the C++ sources are not here")
@pytest.mark.parametrize("options", [[], ["-mavx2"]], ids=["baseline", "avx2"])
def test_extreme_scenes_are_drawn_without_memory_errors(tmp_path: Path, options: list[str]) -> None:
    assert COMPILER is not None
    if options and "avx2" not in Path("/proc/cpuinfo").read_text():
        pytest.skip("this processor has no AVX2")
    program = tmp_path / "fuzz"
    sources = [str(CPP / f"{name}.cc") for name in RENDERER]
    sanitizers = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    language = ["-std=gnu++20", "-O1", "-g", "-w", "-ffp-contract=off", "-DTRUNDLE_ISA=baseline"]
    command = [COMPILER, *language, *sanitizers, *options, str(HERE / "fuzz.cc"), *sources, "-o", str(program)]
    subprocess.run(command, check=True, timeout=900)
    ran = subprocess.run([str(program), "400"], capture_output=True, text=True, timeout=900, check=False)
    assert ran.returncode == 0, ran.stderr[-4000:]
    drawn = int(ran.stdout.split()[0])
    assert drawn > 250
