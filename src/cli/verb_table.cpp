// SPDX-License-Identifier: MIT
//
// What the verbs are, and what --help says of each.
#include "cli/arguments.hpp"

namespace stipple::cli {
namespace {

constexpr VerbInfo generate_verb = {
    Verb::generate,
    "generate",
    "stipple generate GENERATOR [OPTIONS]",
    "makes points",
    R"(The same command gives the same bytes on any machine and for any number of threads: points
depend on generator, options, count, dimension and seed alone.)",
    R"(  stipple generate halton -n 4096 --start 1 -w disk -o points.csv
  stipple generate random -d 5 -n 1e6 --seed 7 -f npy -o points.npy
  stipple generate jittered -m 10 -o 'set{set}.csv'
  stipple generate poisson-disk -n 2000 --bounds 0..40,0..30
)"};

constexpr VerbInfo warp_verb = {
    Verb::warp,
    "warp",
    "stipple warp WARP [INPUT] [OPTIONS]",
    "moves points of the unit cube onto another domain, or back, or scrambles them",
    R"(INPUT is a file of points; standard input by default. WARP@I,J warps coordinates I and J and
leaves the others. Deterministic: the image depends on the points, the options and, for a
scramble, the seed alone.)",
    R"(  stipple warp disk points.csv -o disk.csv
  stipple warp owen points.csv --seed 7 -m 10 -o 'owen{set}.csv'
  stipple warp triangle --vertices '0,0 2,0 0,1' points.csv
  stipple warp disk --inverse disk.csv
)"};

constexpr VerbInfo analyze_verb = {
    Verb::analyze,
    "analyze",
    "stipple analyze ANALYZER [INPUT...] [OPTIONS]",
    "measures point sets",
    R"(INPUTs are files of points; standard input by default. Results are deterministic, for any
number of threads; only "seconds" is measured. --format is text on a terminal, else json.
'mpirun -n 8 stipple analyze ...' shares one set between ranks ('stipple help cluster').)",
    R"(  stipple generate halton -n 1000 | stipple analyze star-discrepancy
  stipple analyze chi-square disk.csv --domain disk --expect uniform
  stipple analyze star-discrepancy a.csv b.csv --format csv
  stipple analyze star-discrepancy a.csv --check 'value<0.01'
  stipple analyze poisson-disk --radius 0.02 --check points.csv
  stipple analyze periodogram --generate sobol:scramble=owen -n 4096 -m 100 --average
)"};

constexpr VerbInfo convert_verb = {
    Verb::convert,
    "convert",
    "stipple convert INPUT... -o OUTPUT [OPTIONS]",
    "from one file format to another",
    R"(The formats are those of the names' extensions, or --from and --format. Every double survives
unless --dtype or --precision cut it.)",
    R"(  stipple convert points.csv -o points.npy
  stipple convert points.bin -d 3 -o points.json
  stipple convert table.csv --column 3,1 -o points.csv
  stipple convert --concat a.csv b.csv -o both.csv
)"};

constexpr VerbInfo plot_verb = {
    Verb::plot,
    "plot",
    "stipple plot [INPUT...] [OPTIONS]",
    "a picture of points, or of an analyzer's JSON",
    R"(INPUTs are files of points or the JSON of 'stipple analyze'; standard input by default. What
is drawn of points, --chart says; of reports, their curves, one for each: radial power and
anisotropy, pair correlation, discrepancy of prefixes. Of several reports without curves one
number (--key) is drawn over the number of points or, where that is the same, as a histogram.
The NPY table of 'periodogram --grid' is drawn as a spectrum. Without -o, standard output gets
SVG or, on a terminal, a quick picture in letters. The same input gives the same bytes.)",
    R"(  stipple generate halton -n 2000 -f json | stipple plot
  stipple plot points.csv --domain disk -o points.svg
  stipple plot points.csv --chart spectrum -o spectrum.png --theme dark
  stipple analyze periodogram a.csv b.csv | stipple plot -o power.svg
  stipple analyze star-discrepancy a.csv b.csv --every 64 | stipple plot -o star.svg
)"};

constexpr VerbInfo study_verb = {
    Verb::study,
    "study",
    "stipple study --generators SPECS -n COUNTS --seeds R --analyze SPECS [OPTIONS]",
    "compares generators over counts, seeds and measures: one tidy table, with statistics",
    R"(Every set (generator, dimension, count, seed) is made once and measured by every analyzer, on all
cores. The table has a row for each number: generator, generator_options, dimension, warps,
count, points (that were measured), seed, measure, measure_options, domain, key, value, status,
reason, study (a hash of all settings), generate_seconds and seconds. Its rows are in the order
of the options; but for the two columns of seconds its bytes are the same for any number of
threads and ranks, and with --no-seconds they are the same altogether.

Rows hold all numbers of a result, flags as 0 and 1; lists (curves) only with --curves or --keys,
or where a result has nothing else. COUNTS are lists 16,64,256 and ranges: 2^4..2^16 (the powers
of 2 between), 16..65536*4 (by a factor), 100..500+100 (by a step). In SPECS a comma before
OPT= goes on with the spec before, other commas and every ; begin the next; values with commas
stand in [brackets]. A measure that cannot take the image of -w, as most discrepancies of the unit
cube, looks at the points before the warp; the column domain says so.

What fails (a count that a generator cannot make, a time limit, a dimension that a measure cannot
take) is a row with status failed and the reason; the exit code is then 5 if a limit of time or
memory was met, else 3. The file is written as the study goes on, with FILE.journal for what is
done out of order: after Ctrl-C (exit 130) or a crash both stay, and --resume goes on, and repairs
what was torn off at the end; rows that somebody took from the middle it cannot know of. A study
that is there already is refused without --resume or --overwrite.

--summary writes FILE.summary and FILE.comparisons with the extension of FILE (behind the rows
where these go to standard output): means with standard errors, t and bootstrap intervals, and
for each dimension, count, measure and key all pairs of generators, by Welch's t test or paired
by seed, with Holm's correction over these pairs. A generator that no seed changes is a constant:
it has no standard error, and against it Welch's test is that of one sample; of two of them, only
whether they differ is known. Generators of one seed share random numbers (those of jittered are
those of random, moved into cells): --pairs paired makes use of that, Welch's test takes the sets
as independent and is, where both move together, the more careful one.

'mpirun -n 8 stipple study ...' shares the work between ranks, where the build has MPI; rank 0 writes.)",
    R"(  stipple study --generators 'random,sobol:scramble=owen' -n 16..256*4 --seeds 8 --analyze star-discrepancy --summary -o study.csv
  stipple study --generators 'random,sobol:scramble=owen' -n 16..256*4 --seeds 8 --analyze star-discrepancy --summary -o study.csv --resume
  stipple study --generators 'halton;jittered' -n 64 --analyze 'l2-discrepancy:kind=centered;moments' -w disk -f jsonl
)"};

constexpr VerbInfo report_verb = {
    Verb::report,
    "report",
    "stipple report [INPUT...] [--generate SPEC ...] -o report.html [OPTIONS]",
    "one self-contained HTML page on point sets: pictures, spectra, all measures, compared",
    R"(INPUTs are files of points; standard input by default, unless --generate names generators. The
page needs nothing but itself: no network, no fonts, no scripts but its own; it is for screens of
any size, light or dark, and for print. First a table that compares the sets, with the best marked,
and the curves of all; then for each set its picture with the worst boxes, projections (for
d > 2), spectrum, radial power, pair correlation, discrepancies, distances, tests of uniformity in
words, its provenance, and the commands that measure every number again. The sets, up to 12, must
have one and the same number of coordinates: points in the plane and points in space are not
compared, and are refused together.

What a measure does not take (a disk, where it needs the unit cube) is left out with the reason.
Searches for worst boxes (in three and more dimensions, in two for some) end after --max-work
comparisons and give certain bounds. No clock decides anything: the same sets give the same bytes
for any number of threads.

KEYs of --fail-on are MEASURE.RESULT: star-discrepancy.value, l2-discrepancy.centered.value,
chi-square.verdict, kolmogorov-smirnov.p_value[0]; --json has them all. MEASURE alone is its value,
where it has one. Words are compared with == and !=. A condition that bounds leave open, or that
is of a measure that was left out, fails as well. The page is written nevertheless.)",
    R"(  stipple report a.csv b.csv -o report.html
  stipple report --generate halton --generate sobol:scramble=owen --generate random -n 512 -o report.html
  stipple report points.csv --json --fail-on 'star-discrepancy>0.5' --fail-on 'chi-square.verdict==non-uniform' -o report.json
)"};

constexpr VerbInfo list_verb = {
    Verb::list,
    "list",
    "stipple list [KIND] [OPTIONS]",
    "every unit with its options",
    R"(KIND is generators, scrambles, warps, analyzers or formats; all of them by default.)",
    R"(  stipple list generators
  stipple list --json
)"};

constexpr VerbInfo reproduce_verb = {
    Verb::reproduce,
    "reproduce",
    "stipple reproduce FILE [OPTIONS]",
    "makes a file's points again from its own provenance, and says whether they are identical",
    R"(FILE is json or jsonl, which always tell how their points were made, or what was written with
--meta: text, ply, svg, or npy, bin and psa with FILE.meta.json beside; or the picture of
--mask-image. Every number is compared as it was written: cut to float32 or to digits, as the
provenance says. The exit code is 0 for identical points, and 1 for others: the first number that
differs is named. It is 1, too, where the rules of a unit changed since, as its stream version
tells. Files that the points were made from must still be there, as they were. A picture by
'stipple plot' of one set tells which: -o makes that set again.)",
    R"(  stipple generate sobol --scramble owen --meta -o a.csv && stipple reproduce a.csv
  stipple generate random -f npy --meta -o a.npy && stipple reproduce a.npy --json
  stipple generate halton -f json | stipple reproduce - -o again.csv
)"};

constexpr VerbInfo help_verb = {Verb::help,
                                "help",
                                "stipple help [TOPIC | VERB [UNIT]] [OPTIONS]",
                                "explains a topic, a verb or a unit",
                                R"('stipple help' lists the topics.)",
                                R"(  stipple help choosing-a-sampler
  stipple help generate halton
  stipple help --man generate > stipple-generate.1
)"};

constexpr VerbInfo completions_verb = {
    Verb::completions,
    "completions",
    "stipple completions bash|zsh|fish",
    "what makes a shell complete stipple's words",
    R"(Packages put it where shells look. Without one, bash takes it from ~/.bashrc, zsh from a file
_stipple in a folder of $fpath, fish from ~/.config/fish/completions/stipple.fish.)",
    R"(  source <(stipple completions bash)
  stipple completions zsh > _stipple
)"};

}  // namespace

const std::vector<VerbInfo>& verbs() {
    static const std::vector<VerbInfo> table = {
        generate_verb, warp_verb, analyze_verb,   convert_verb, plot_verb,       study_verb,
        report_verb,   list_verb, reproduce_verb, help_verb,    completions_verb};
    return table;
}

}  // namespace stipple::cli
