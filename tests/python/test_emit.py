# SPDX-License-Identifier: MIT
"""Compiles and runs the code that `stipple emit` writes, and compares its numbers with the program's."""
import os
import re
import shutil
import subprocess

import numpy as np
import pytest

# Generator, dimension, count if the points depend on it, languages without it.
SAMPLERS = [
    ("sobol", 16, None, ""),
    ("sobol:scramble=owen", 4, None, ""),
    ("sobol:scramble=digital-shift,order=gray", 3, None, ""),
    ("sobol:scramble=matrix", 3, None, ""),
    ("halton", 16, None, ""),
    ("halton:scramble=faure", 5, None, ""),
    ("halton:scramble=reverse", 5, None, ""),
    ("halton:scramble=permutation", 5, None, "glsl hlsl"),
    ("halton:scramble=owen", 5, None, "glsl hlsl"),
    ("van-der-corput", 1, None, ""),
    ("van-der-corput:base=1000", 1, None, ""),
    ("kronecker", 4, None, ""),
    ("kronecker:alpha=richtmyer,offset=0.5", 3, None, ""),
    ("hammersley", 4, 1000, ""),
    ("hammersley:sweep=last,offset=half", 3, 2**32 - 5, ""),
    ("rank1-lattice:vector=[1,182667,469891]", 3, 2**20, ""),
    ("rank1-lattice:vector=[1,433461,123457]", 3, 2**32 - 5, ""),
    ("rank1-lattice:vector=[1,433461]", 2, 2**45 - 7, "glsl hlsl"),
    ("jittered", 2, 1000, ""),
    ("jittered", 2, 2**28, ""),
    ("jittered:cell=center", 2, 999, ""),
    ("jittered:shape=5x4x6", 3, 120, ""),
    ("multi-jittered", 2, 64, ""),
    ("multi-jittered", 2, 1009, ""),
    ("multi-jittered", 2, 2**26 + 3, ""),
    ("multi-jittered:order=cells,centered=true", 2, 40, ""),
    ("correlated-multi-jittered", 2, 1000, ""),
]
WARPS = [
    ("disk", 2),
    ("disk:method=concentric,radius=2.5,center=[1,-3]", 2),
    ("triangle", 2),
    ("triangle:method=low-distortion,vertices=[0,0,1 2,0,0 0,3,0.5]", 3),
    ("sphere:radius=0.5,center=[1,2,3]", 3),
    ("hemisphere", 3),
    ("hemisphere:method=cosine", 3),
    ("hemisphere:method=cosine,disk=concentric", 3),
    ("cone", 3),
    ("cone:half-angle=150", 3),
]
PLACED = "-w cone@1,4 -w disk@4,5"  # rows of 6: the direction, the first free one, the disk
SEEDS = [7, 2**60 + 12345]
SHORT_SEEDS = [7, 4_000_000_000]  # of shaders


class Case:
    """A sampler, and the indices at which it is tested."""

    def __init__(self, number, generator, dimension, count, without="", warps=(), width=None):
        self.name = f"s{number}"
        self.generator, self.dimension, self.count = generator, dimension, count
        self.without, self.warps, self.width = without, warps, width or dimension
        self.seeded = "jittered" in generator or "scramble=" in generator

    def seeds(self, seeds):
        return seeds if self.seeded else seeds[-1:]

    def words(self):
        words = [self.generator, f"-d{self.dimension}"]
        return words + ([f"-n{self.count}"] if self.count else []) + list(self.warps)

    def blocks(self, wide):
        """First index and number of points of each block; `wide`: beyond 32 bits, too."""
        if self.count is None:
            blocks = [(0, 1000), (2**31 - 7, 50), (2**32 - 60, 60)] + [(2**40 - 3, 50)] * wide
            return blocks if "base=1000" not in self.generator or not wide else blocks[:3] + [(2**40, 50)]
        if self.count < 2000:
            return [(0, self.count)]
        shards = self.count // 64
        return [(shard * self.count // shards, 64) for shard in (0, shards // 2, shards - 1)]

    def expected(self, run, first, number, seed):
        """Points of the program, as float64."""
        if self.count is None:
            words = [self.generator, f"-d{self.dimension}", f"-n{number}", f"--start={first}", *self.warps]
            out = run("generate", *words, f"--seed={seed}", "-fbin", "--quiet")
        elif self.count < 2000:
            out = run("generate", *self.words(), f"--seed={seed}", "-fbin", "--quiet")
        else:
            shards = self.count // 64
            index = next(i for i in range(first * shards // self.count, shards) if i * self.count // shards == first)
            out = run("generate", *self.words(), f"--seed={seed}", f"--shard={index}/{shards}", "-fbin", "--quiet")
        return np.frombuffer(out).reshape(-1, self.width)[:number]


CASES = [Case(i, *sampler) for i, sampler in enumerate(SAMPLERS)]
WARPED = [Case(100 + i, "sobol:scramble=owen", 2, None, "", ("-w", warp), width) for i, (warp, width) in enumerate(WARPS)]
WARPED.append(Case(199, "halton", 5, None, "", tuple(PLACED.split()), 6))


def cut(x):
    """float32 of x, rounded toward zero."""
    single = x.astype(np.float32)
    return np.where(np.abs(single.astype(float)) > np.abs(x), np.nextafter(single, np.float32(0)), single)


@pytest.fixture(scope="module")
def answers():
    """Points of the program by case, first index and seed."""
    return {}


@pytest.fixture(scope="module")
def emitted(run):
    """Code of a case in a language."""
    known = {}

    def call(case, language):
        if (case.name, language) not in known:
            words = [*case.words(), f"--language={language}", f"--name={case.name}"]
            known[case.name, language] = run("emit", *words).decode()
        return known[case.name, language]

    return call


def expected(run, answers, case, seeds, wide):
    """All expected numbers of a case, one row a point."""
    rows = []
    for first, number in case.blocks(wide):
        for seed in case.seeds(seeds):
            key = (case.name, first, seed)
            if key not in answers:
                answers[key] = case.expected(run, first, number, seed)
            rows.append(answers[key])
    return np.concatenate(rows)


C_MAIN = """
#include <stdio.h>
{includes}
int main(void) {{
    {integer} i, first, seed;
    unsigned k;
    {real} p[16];
    {calls}
    return 0;
}}
"""


def calls(case, seeds, wide, suffix, address="&"):
    """Statements that write all numbers of a case. Numbers made with a key must be the same."""
    lines = []
    name, d = case.name, case.dimension
    with_key = any(f"scramble={word}" in case.generator for word in ("owen", "digital-shift", "matrix", "permutation"))
    for first, number in case.blocks(wide):
        for seed in case.seeds(seeds):
            lines.append(f"first = {first}{suffix}, seed = {seed}{suffix};")
            if case.warps:
                lines.append(f"for (i = 0; i < {number}; ++i) {{ {case.name}_point(first + i, seed, p);"
                             f" fwrite(p, sizeof *p, {case.width}, stdout); }}")
            else:
                lines.append(f"for (i = 0; i < {number}; ++i) for (k = 0; k < {d}; ++k) {{"
                             f" p[0] = {name}(first + i, k, seed); fwrite(p, sizeof *p, 1, stdout); }}")
            if with_key and not case.warps:
                lines.append(f"for (k = 0; k < {d}; ++k) {{ {name}_key key = {name}_key_of(k, seed); for (i = 0; i < {number}; ++i)"
                             f" if ({name}_at(first + i, {address}key) != {name}(first + i, k, seed)) return 1; }}")
    return lines


def compile_and_run(folder, command, source, text):
    (folder / source).write_text(text)
    subprocess.run([*command, source, "-o", "a.out", "-lm"], cwd=folder, check=True)
    return subprocess.run([folder / "a.out"], check=True, capture_output=True).stdout


STRICT = "cc -std=c99 -pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Werror -O3 -march=native -ffp-contract=off"
AS_CPP = "c++ -x c++ -std=c++11 -Wall -Wextra -Wconversion -Wsign-conversion -Werror -O1 -march=native -ffp-contract=off"


def demands(code):
    """The options that a comment asks for."""
    return [flag for flag in ("-ffp-contract=off", "-ffast-math") if flag in code]


# What the comments of no code forbid changes nothing.
FUSED = "cc -std=c99 -O3 -march=native -ffp-contract=fast"
FAST = "cc -std=c99 -O3 -march=native -ffast-math"


@pytest.mark.parametrize("command", [STRICT, AS_CPP, FUSED, FAST])
def test_c_gives_the_programs_bits(run, answers, emitted, tmp_path, command):
    forbidden = {FUSED: ["-ffp-contract=off"], FAST: ["-ffp-contract=off", "-ffast-math"]}.get(command, [])
    cases = [case for case in CASES + WARPED if not set(demands(emitted(case, "c"))) & set(forbidden)]
    assert {"sobol", "sobol:scramble=owen", "kronecker"} <= {case.generator for case in cases}
    text = C_MAIN.format(
        includes="".join(emitted(case, "c") for case in cases), integer="uint64_t", real="double",
        calls="\n    ".join(line for case in cases for line in calls(case, SEEDS, True, "u")))
    numbers = np.frombuffer(compile_and_run(tmp_path, command.split(), "main.c", text))
    for case in cases:
        there = expected(run, answers, case, SEEDS, True)
        here, numbers = numbers[: there.size], numbers[there.size :]
        assert here.tobytes() == there.tobytes(), case.words()
    assert numbers.size == 0


def test_python_gives_the_programs_bits(run, answers, emitted):
    for case in CASES + WARPED:
        scope = {}
        exec(emitted(case, "python"), scope)
        expected(run, answers, case, SEEDS[1:], True)
        for first, number in case.blocks(True):
            there = answers[case.name, first, SEEDS[1]]
            for i in range(0, number, 1 + number // 20):
                at = first + i, SEEDS[1]
                here = (scope[f"{case.name}_point"](*at) if case.warps
                        else [scope[case.name](at[0], k, at[1]) for k in range(case.dimension)])
                assert here == list(there[i]), (case.words(), at)


# What the shaders use of their languages, for a C++ compiler.
SHADER = """
#include <cmath>
#include <cstdint>
#include <cstring>
typedef uint32_t uint;
struct uvec2 { uint x, y; uvec2() {} uvec2(uint a, uint b) : x(a), y(b) {} };
struct vec2 { float x, y; vec2() {} vec2(float a, float b) : x(a), y(b) {} float& operator[](int k) { return k ? y : x; } };
struct vec3 { float x, y, z; vec3() {} vec3(float a, float b, float c) : x(a), y(b), z(c) {}
              float& operator[](int k) { return k == 0 ? x : k == 1 ? y : z; } };
inline float uintBitsToFloat(uint x) { float f; memcpy(&f, &x, 4); return f; }
inline int findMSB(uint x) { return x == 0 ? -1 : 31 - __builtin_clz(x); }
inline float max(float a, float b) { return a > b ? a : b; }
inline float min(float a, float b) { return a < b ? a : b; }
inline uint min(uint a, uint b) { return a < b ? a : b; }
inline float radians(float x) { return x * 0.0174532925f; }
inline float sqrt(float x) { return std::sqrt(x); }
inline float abs(float x) { return std::fabs(x); }
"""
HLSL_WORDS = """
#define uint2 uvec2
#define float2 vec2
#define float3 vec3
#define asfloat uintBitsToFloat
#define firstbithigh findMSB
"""


def as_cpp(shader):
    """A shader's function in C++: brackets of arrays, and parameters that are results."""
    text = re.sub(r"= \w+\[\d+\]\(\n([^;]*)\n( *)\);", r"= {\n\1\n\2};", shader)
    text = re.sub(r"\b(?:inout|out(?= u)) (\w+) ", r"\1& ", text)
    return re.sub(r"\bout float ", "float ", text)


@pytest.mark.parametrize("language", ["glsl", "hlsl"])
def test_shaders_give_the_programs_numbers_cut_to_float32(run, answers, emitted, tmp_path, language):
    seeds = SHORT_SEEDS
    cases = [case for case in CASES + WARPED if language not in case.without]
    text = SHADER + HLSL_WORDS
    for case in cases:
        text += as_cpp(emitted(case, language))
    text += C_MAIN.format(includes="", integer="uint", real="float",
                          calls="\n    ".join(line for case in cases for line in calls(case, seeds, False, "u", "")))
    numbers = np.frombuffer(compile_and_run(tmp_path, ["c++", "-O1", "-w", "-ffp-contract=off", "-fsingle-precision-constant"], "main.cpp", text), np.float32)
    for case in cases:
        there = cut(expected(run, answers, case, seeds, False))
        here, numbers = numbers[: there.size].reshape(there.shape), numbers[there.size :]
        if case.warps:
            np.testing.assert_allclose(here, there, rtol=0, atol=3e-6, err_msg=str(case.words()))
        else:
            assert np.array_equal(here, there), case.words()
    assert numbers.size == 0


@pytest.mark.parametrize("language", ["glsl", "hlsl"])
def test_shaders_compile(emitted, tmp_path, language):
    validator = shutil.which("glslangValidator")
    assert validator, "scripts/setup tests installs glslang-tools"
    code = body = ""
    for case in CASES + WARPED:
        if language in case.without:
            continue
        code += emitted(case, language)
        body += (f"{{ float p[{case.width}]; {case.name}_point(1u, 2u, p); x += p[0]; }}\n" if case.warps
                 else f"x += {case.name}(1u, 0u, 2u);\n")
    body = f"void main() {{\nfloat x = 0.0;\n{body}r[0] = x;\n}}\n"
    if language == "glsl":
        code = f"#version 450\n{code}layout(local_size_x = 1) in;\nlayout(binding = 0) buffer R {{ float r[]; }};\n{body}"
    else:
        code += f"RWStructuredBuffer<float> r : register(u0);\n[numthreads(1, 1, 1)] {body}"
    (tmp_path / "all.comp").write_text(code)
    flags = ["-V"] if language == "glsl" else ["-D", "-V", "-e", "main", "-S", "comp"]
    found = subprocess.run([validator, *flags, "all.comp", "-o", "all.spv"], cwd=tmp_path, capture_output=True, text=True)
    assert found.returncode == 0, found.stdout


KEYWORDS = {"c": "double main index sin class nullptr uint64_t memcpy", "glsl": "sample float main buffer uvec2 findMSB",
            "hlsl": "sample float main cbuffer uint2 firstbithigh", "python": "lambda None range math index WORD sum lru_cache"}


@pytest.mark.parametrize("language", KEYWORDS)
def test_names_that_mean_something_else_are_refused(language):
    program = os.environ["STIPPLE_PROGRAM"]

    def emit(name, *words):
        return subprocess.run([program, "emit", *words, f"--language={language}", f"--name={name}"], capture_output=True, text=True)

    words = ["sobol", "--scramble=owen", "-w", "disk"]
    code = emit("lens", *words).stdout
    code = re.sub(r'"""[^"]*"""|#.*', "", code) if language == "python" else re.sub(r"/\*.*?\*/|^#[^\n]*", "", code, flags=re.S | re.M)
    own = {word for word in re.findall(r"(?<!\w)[A-Za-z_]\w*", code) if word != "lens" and not word.startswith("lens_")}
    assert {"index", "fraction", "seed"} <= own
    for name in own | set(KEYWORDS[language].split()):
        found = emit(name, *words)
        assert found.returncode == 2 and f"--name: '{name}' is a" in found.stderr, name
    for name in ("lens", "_lens", "indexes", "Sample2", "sobol_unit", "my_uvec2"):
        assert emit(name, "sobol").returncode == 0, name
    assert "my_uvec2(" in emit("my_uvec2", "sobol").stdout
