// SPDX-License-Identifier: MIT
#include "cli/topics.hpp"

namespace stipple::cli {
namespace {

constexpr const char* choosing = 1 + R"(
A short way through the generators ('stipple list generators' names all, with their
sources). What is best depends on the integrand or on the eye: measure, as below.

To integrate, in few or in many dimensions
  sobol with --scramble owen, and a power of two of points. For smooth integrands its error
  falls faster than that of random points; for rough ones it is seldom worse. Rank-1
  lattices ('rank1-lattice --rule cbc') suit integrands that are periodic and smooth.
  One set of such points has no error bar. Make several, each scrambled with its own seed,
  and take the spread of their results:

    stipple generate sobol -n 1024 -d 5 --scramble owen -m 16 -o replications.csv
    stipple analyze integration replications.csv --average

  Dropping points from the front, or stopping at another number than a power of two, takes
  most of the advantage away.

To test, to simulate, to compare with
  random: independent points, in any dimension; its error is known before, and falls as
  1 / sqrt(n). jittered and latin-hypercube are the first steps up from it: one point in
  every cell of a grid, or in every strip of every axis (for few points in many
  dimensions, as computer experiments have them).

    stipple generate latin-hypercube -n 50 -d 8 -o experiments.csv

To render pictures
  pmj02 or sobol with --scramble owen for the samples of a pixel; name the coordinates that
  are warped, so that one row holds what belongs together:

    stipple generate sobol --scramble owen -n 256 -d 4 -w pixel@1,2 -w disk@3,4 -o rows.csv

To stipple, to dither, to place things that must not touch (blue noise)
  poisson-disk keeps a distance and leaves no gap; it takes --density pictures, boxes and a
  number of points. best-candidate, sample-elimination and dart-throwing are older ways to
  points like these; lloyd, capacity-constrained and gaussian-blue-noise move points apart, and
  are more even and slower; void-and-cluster makes dither masks.

    stipple generate poisson-disk -n 1000 -o blue.csv
    stipple analyze nearest-neighbor blue.csv

To cover a space, or to search it
  halton or kronecker where the number of points is not known before: every first part of
  them is even. farthest-point keeps every next point as far as it can from all others.

    stipple generate halton -n 500 -o search.csv
    stipple analyze dispersion search.csv

For lessons
  grid, hexagonal, van-der-corput, hammersley; 'random --rng' has generators of old that
  show their faults.
)";

constexpr const char* definitions = 1 + R"(
What the numbers mean that stipple prints. n points x_j have d coordinates each.

Star discrepancy
  The largest difference between the fraction of points in a box [0,c) and the volume of
  the box, over all corners c of the unit cube. A box with its faces counts, too: exactly,
  the maximum over corners c made of coordinates and 1 of vol(c) - #{x < c}/n and
  #{x <= c}/n - vol(c).

    stipple generate halton -n 100 | stipple analyze star-discrepancy

Extreme and periodic discrepancy, dispersion
  --kind extreme takes all boxes [a,b) with a <= b instead, --kind periodic also those that
  go on across the faces, where a coordinate of 1 is that of 0; with their faces or without,
  whichever differs more. dispersion is the largest volume of a box without a point.

    stipple generate halton -n 100 | stipple analyze star-discrepancy --kind periodic

L2 discrepancies
  The same differences, squared and averaged over boxes: `value` is the root, `squared` the
  square, both always given. star is Warnock's; centered and wraparound are Hickernell's
  (1998), mixture is Zhou, Fang and Ning's (2013). SciPy's CD, WD and MD are their squares.
  All of them are squared = II K(x,y) dx dy - 2/n sum_i I K(x_i,y) dy + sum_ij K(x_i,x_j) / n^2
  with a product K over the axes of k for star, extreme and periodic, of 1 + k for the others,
  of 1 + w k with --weights; with t = |x - y|, k is

    star, modified        1 - max(x,y)         extreme     min(x,y) - x y
    periodic, wraparound  1/2 - t + t^2        centered    (|x-1/2| + |y-1/2| - t) / 2
    diaphony              2 pi^2 (1/6 - t + t^2)
    mixture               7/8 - (|x-1/2| + |y-1/2| + 3t) / 4 + t^2 / 2

    stipple generate sobol -n 256 -d 4 | stipple analyze l2-discrepancy --kind centered

Power
  P(f) = |sum_j exp(-2 pi i f.x_j)|^2 / n at a vector f of whole numbers that is not 0: white
  noise has mean 1. Radial bins are one unit of frequency wide; anisotropy is the variance
  over a bin divided by the squared mean, in dB.

    stipple generate poisson-disk -n 500 | stipple analyze periodogram --max-frequency 40

Distances
  are on the torus on the unit cube, unless --metric euclidean is given; the output says
  which. relative_radius is the least distance over the one that the densest packing of n
  points on the unit torus has.

    stipple generate poisson-disk -n 500 | stipple analyze nearest-neighbor

chi-square
  Points counted in cells of known probability. The test looks at both tails: too large a
  statistic is `non-uniform`, too small a one is `stratified`, more even than points at
  random are: good news for low-discrepancy sets.

    stipple generate halton -n 4096 | stipple analyze chi-square --expect stratified

Domain and density
  What warped points live on, as their file says or as --domain does; tests of uniformity
  are tests for the domain's own density.

    stipple generate random -n 4096 -w disk | stipple analyze chi-square --domain disk

Index
  The first point of a sequence has the index 0, and is the origin for halton and sobol.
  --start 1 gives the textbooks' Halton points.

    stipple generate halton -n 5 --start 1
)";

constexpr const char* formats = 1 + R"(
Formats of point files: 'stipple list formats' has them in short. A file's extension tells
its format, or --format when it is written, --from when it is read; npy and json are known
by their first bytes.

csv (.csv)
  A header x / x,y / x,y,z or, from four coordinates on, x1,...,xd; with several sets a
  first column `set`. --no-header leaves it out. Density and weight (--with-pdf,
  --with-weight) stand behind the coordinates.
txt (.txt .dat)
  A point a line, its coordinates parted by a blank; a line # between two sets.
json (.json)
  {"format":"stipple.points","version":1,"meta":{...},"dimension":d,"count":n,
  "points":[[...],...]}; with several sets "sets":[[[...]]] in place of points.
jsonl (.jsonl)
  One object with the same keys, then a point [x,y] a line; for each set.
npy (.npy)
  NumPy, shape (n, d), or (sets, n, d).
bin (.bin .f64 .f32)
  Raw little-endian numbers, point after point. Reading them needs -d.
psa (by name)
  A line with the number of points, then `x y` a line.
ply, svg (.ply .svg)
  For other programs and for the eye; they are not read.

    stipple generate halton -n 100 -o points.csv
    stipple convert points.csv -o points.npy
    stipple convert points.npy -f txt

Reading takes commas, semicolons, tabs or blanks, a header or none, comments (#), CRLF, and
a missing final newline. It refuses words among the numbers, rows of different length, NaN,
infinities and empty files, and says where. --column picks columns by name or number:

    stipple convert points.csv --column y,x -o turned.csv

Text holds the shortest numbers that read back to the same doubles; --precision P keeps P
digits after the point, and --dtype f32 makes binary formats float32. Both cut toward zero,
so that what is below 1 stays below 1.

Many files are one set with --concat, in their order:

    stipple generate sobol -n 1024 --shard 0/2 -o part0.csv
    stipple generate sobol -n 1024 --shard 1/2 -o part1.csv
    stipple convert --concat part0.csv part1.csv -o whole.csv
    stipple analyze moments --concat part0.csv part1.csv

Where points come from is in the `meta` of json and jsonl. --meta puts it in lines
`# key: value` on top of csv and txt, in comments of ply, in the metadata of svg, and, for npy,
bin and psa, in a file FILE.meta.json beside (see 'stipple help reproducibility').
)";

constexpr const char* reproducibility = 1 + R"(
The same command gives the same bytes: on any machine, for any number of threads, whatever
else it does. Nothing is drawn from the clock: the seed is 1 unless --seed says otherwise,
and --seed random tells the one that it drew.

    stipple generate random -n 1000 --seed 7 --threads 1 -o one.csv
    stipple generate random -n 1000 --seed 7 --threads 2 -o two.csv

Sets of one command (-m) have the seeds S, S+1, ...: set 3 of --seed 1 is the only set of
--seed 4. Parts of a set (--shard I/K) are the whole when they are put together.

A file that tells where it comes from can be made again:

    stipple generate poisson-disk -n 300 --meta -o blue.csv
    stipple reproduce blue.csv

json and jsonl always tell; --meta makes other formats do so. `reproduce` compares number by
number, as they were written, with the points that the file's command makes today, and with
the warps, cuts and scrambles of later commands after it:

    stipple warp disk blue.csv --meta --precision 6 -o disk.csv
    stipple reproduce disk.csv

In `meta`, `command` is what was asked for; `options` also holds what was worked out, such as
the radius that poisson-disk found. Files that points were made from (a density, a mesh, a
table) are named under `inputs` with a fingerprint of their bytes, so that a changed one is
noticed.

Every unit that makes or moves points has a stream version, 1 at first ('stipple list --json').
A release that changes the points that the same options and seed give raises it; points of a
later version than the first carry it under `stream_versions`, and `reproduce` says that the
rules changed instead of that the points differ.

What is not promised: results of analyzers are the same for any number of threads, but may
differ in their last digits from one machine to another.
)";

constexpr const char* exit_codes = 1 + R"(
0    done
1    a --check, --expect or --fail-on did not hold; reproduce: not identical
2    wrong usage
3    bad input: the message names the file, the line or byte, and what was expected
4    cannot read or write
5    over a limit: memory, work
130  interrupted

An error is one line on standard error, with a hint where one helps. A command that fails
writes nothing to its target: a file that was there before is as it was; only a study keeps
the rows that it has. A reader that closes the pipe is no error.

--check makes any result a condition, for scripts and continuous integration:

    stipple generate sobol -n 1024 | stipple analyze star-discrepancy --check 'value<0.01'
    stipple generate random -n 4096 | stipple analyze chi-square --expect uniform
    stipple generate poisson-disk -n 500 | stipple analyze poisson-disk --check
)";

constexpr const char* specs = 1 + R"(
A spec names a unit with its options in one word:

    NAME[@I,J...][:OPTION=VALUE[,OPTION=VALUE...]]

as --warp and --domain take it, and as provenance holds it. A value with commas or blanks stands
in brackets; a flag stands alone. In a shell, quote it.

    stipple generate random -n 500 -w disk:radius=2 -o disk.csv
    stipple generate random -n 500 -w 'triangle:vertices=[0,0 2,0 0,1]' -o triangle.csv
    stipple analyze chi-square triangle.csv --domain 'triangle:vertices=[0,0 2,0 0,1]'

The same options as words of their own need no brackets:

    stipple generate random -n 500 -o points.csv
    stipple warp triangle --vertices '0,0 2,0 0,1' points.csv -o triangle.csv

@I,J applies a warp or a scramble to those coordinates, numbered from 1, and leaves the
others: here pixels, time and the lens of a camera in one row. Later specs count the
coordinates of the row as it then is.

    stipple generate sobol -n 256 -d 5 -w pixel@1,2 -w disk@4,5 -o camera.csv

Whole numbers may be written 1000, 1e6, 2^20 or 64k (= 65536); sizes 500M or 2G; boxes
lo..hi for all coordinates or lo..hi,lo..hi,... for each.

    stipple generate poisson-disk -n 300 --bounds 0..4,0..3 -o box.csv
)";

constexpr const char* cluster = 1 + R"(
Three ways to more than one machine. All of them give the bytes that one process gives.

Job arrays: parts of a set
  --shard I/K makes the I-th of K parts of a sequence, from 0; --concat takes them as one set:

    stipple generate sobol -n 2^16 --shard 0/2 -o part0.npy
    stipple generate sobol -n 2^16 --shard 1/2 -o part1.npy
    stipple analyze chi-square --concat part0.npy part1.npy

  The same as a Slurm array, and with GNU parallel:

      #!/bin/sh
      #SBATCH --array=0-63
      stipple generate sobol -n 2^36 --shard $SLURM_ARRAY_TASK_ID/64 \
          -o part$SLURM_ARRAY_TASK_ID.npy

      seq 0 63 | parallel stipple generate sobol -n 2^36 --shard {}/64 -o part{}.npy

  In a shell, part{0..63}.npy names them in their order; part*.npy does not: 10 is before 2.

MPI: one set, measured by many ranks
  'stipple --version' tells the build's MPI; a build without one says so when a launcher starts
  it. chi-square, kolmogorov-smirnov, moments and periodogram take files (each rank its stretch
  of the points, wherever the files end) or --generate (nobody stores the points):

      mpirun -n 64 stipple analyze moments --concat part{0..63}.npy
      srun -n 1024 stipple analyze chi-square --generate random -n 1e12

  Points are cut into grains: 2^18 numbers or, for periodogram, as many points as its grid has
  cells, 2^24 to 2^26. A set of fewer grains than ranks leaves ranks idle. All ranks must see
  the files; npy and bin are read once, each point by one rank, text twice, since nobody knows
  where its points stand. periodogram shares --method nufft. star-discrepancy shares its search
  in 3 and more dimensions, 64 cells a round: more than 64 ranks do not help. Each rank has all
  points, and climbs by itself.

MPI: many sets
  'mpirun -n 64 stipple study ...' shares the sets of a study; 'stipple help study' tells how it
  goes on after a crash. Rank 0 has every row on the disk within a second of getting it; when a
  rank is lost, the launcher ends the others, and --resume does what is missing. After Ctrl-C
  what is done stays as well, but Open MPI's mpirun exits with 1, whatever its ranks end with; a
  signal to a rank itself makes rank and mpirun exit with 130.

On paper: 10^12 points in the plane, made by 'random', on 1024 ranks of one core
  Counted with 31, 30 and 100 ns a point (measured on one core at 2 to 3 GHz), messages of 5 us
  and 2 GB/s, and 3 s until all processes have found each other; tests/bench/cluster_model.py
  has the formulas and takes other numbers.

                one core     1024 ranks   of these, to merge   efficiency   memory a rank
  chi-square     8.6 hours       33 s         < 1 ms               91 %           4 MiB
  moments        8.3 hours       32 s         < 1 ms               91 %           4 MiB
  periodogram   27.8 hours      105 s         2.7 s                93 %         768 MiB

  What is lost is the start, all but 0.1 % (periodogram: 3 %) of it. Every rank sends what it
  knows once: 40 KiB, 10 KiB and 256 MiB, however many points there were; rank 0 takes in ten
  of these, for ranks hand over in pairs. From files the same takes 160 s: 16 TB at the
  100 GB/s that a large parallel file system has are the limit then, not the cores.
  A study's ranks send 150 to 250 bytes a row, and ask once a second: 1024 ranks keep rank 0
  busy for less than a tenth of its time. Its efficiency is that of the longest single set: one
  that takes longer than the rest over the number of ranks is waited for.
)";

}  // namespace

const std::vector<Topic>& topics() {
    static const std::vector<Topic> table = {
        {"choosing-a-sampler", "which generator for what", choosing},
        {"cluster", "job arrays, MPI, and what 10^12 points cost", cluster},
        {"definitions", "what the measures mean, exactly", definitions},
        {"exit-codes", "what the exit codes mean, and checks in scripts", exit_codes},
        {"formats", "point files, reading and writing", formats},
        {"reproducibility", "the same bytes again: seeds, provenance, versions", reproducibility},
        {"specs", "units with options in one word, and how numbers are written", specs}};
    return table;
}

}  // namespace stipple::cli
