// SPDX-License-Identifier: MIT
//
// What `stipple emit` accepts and refuses; tests/python/test_emit.py compiles and runs the code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/program.hpp"

namespace stipple::testing::emit_test {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Emit, CodeNamesItsCommandAndHasTheProgramsPoints) {
    const Sandbox box;
    const std::string code =
        good(box.shell("stipple emit sobol:scramble=owen -d 3 --name s -o s.h; cat s.h"));
    EXPECT_THAT(code, HasSubstr("stipple emit sobol --scramble owen --dimension 3 --name s\n"));
    std::string first =
        good(box.shell("stipple generate sobol --scramble owen -d 3 -n 2 -s 2 -f txt | head -1"));
    EXPECT_THAT(code, HasSubstr("seed 2, point 0: " + first));
    EXPECT_THAT(code, HasSubstr("double s(uint64_t index, unsigned dimension, uint64_t seed)"));
    EXPECT_THAT(code, Not(HasSubstr("{{")));
    EXPECT_THAT(code, Not(HasSubstr("@")));
}

// Only what a sampler needs is in its file.
TEST(Emit, PartsComeOnceAndByNeed) {
    const Sandbox box;
    const std::string plain = good(box.run({"emit", "sobol"}));
    EXPECT_THAT(plain, Not(HasSubstr("sobol_random(")));
    const std::string warped = good(box.run({"emit", "sobol", "-d", "4", "-w", "disk@1,2", "-w",
                                             "disk@3,4:radius=2", "--language", "python"}));
    const auto count = [&](const std::string& text) {
        std::size_t found = 0;
        for (auto at = warped.find(text); at != warped.npos; at = warped.find(text, at + 1))
            ++found;
        return found;
    };
    EXPECT_EQ(count("def sobol_cos_sin("), 1U);
    EXPECT_EQ(count("def sobol_disk"), 2U);
}

// Options of the compiler stand where they matter.
TEST(Emit, CommentsNameOptionsThatMatter) {
    const Sandbox box;
    const auto code = [&](const std::string& arguments) {
        return good(box.shell("stipple emit " + arguments));
    };
    for (const char* exact : {"sobol --scramble owen", "kronecker -d 3"})
        EXPECT_THAT(code(exact), Not(HasSubstr("ompile with"))) << exact;
    for (const char* divided : {"halton", "jittered -n 100 --cell center", "rank1-lattice -n 64"}) {
        EXPECT_THAT(code(divided), HasSubstr("Compile without -ffast-math.\n")) << divided;
        EXPECT_THAT(code(divided), Not(HasSubstr("-ffp-contract"))) << divided;
    }
    for (const char* fused : {"halton --scramble owen", "jittered -n 100", "sobol -w disk"})
        EXPECT_THAT(code(fused), HasSubstr("with -ffp-contract=off")) << fused;
}

// Powers of these bases, and of 41 and 43, overflow to small numbers.
TEST(Emit, TakesAnyBase) {
    const Sandbox box;
    for (const char* base : {"16", "256", "7168", "65536"})
        EXPECT_THAT(good(box.run({"emit", "van-der-corput", "--base", base})), HasSubstr(base));
    const std::string code = good(box.run({"emit", "halton:scramble=permutation", "-d", "14"}));
    EXPECT_THAT(code, HasSubstr("images[516]"));  // 43 images for each of 12 digits
}

// A path cannot end the comment that it is in.
TEST(Emit, CommentsStayComments) {
    const Sandbox box;
    const std::string code =
        good(box.shell("mkdir 'a*'; printf 'd s a m\\n2 1 0 1\\n' > 'a*/b'; "
                       "stipple emit sobol --directions 'a*/b'"));
    EXPECT_THAT(code, Not(HasSubstr("a*/")));
}

TEST(Emit, RefusesWithASentence) {
    const Sandbox box;
    const auto refuses = [&](const std::string& arguments, const std::string& words) {
        expect_refusal(box.shell("stipple emit " + arguments), 2, words);
    };
    refuses("poisson-disk",
            "poisson-disk cannot be emitted; these can be: correlated-multi-jittered");
    refuses("", "name one of the generators");
    refuses("halton --leap 5", "--leap: cannot be emitted for halton");
    refuses("sobol -d 17", "--dimension: 17 is outside [1, 16]");
    refuses("sobol --language rust", "rust");
    refuses("sobol --name 2d", "--name: '2d' is not a name");
    refuses("sobol -d 0", "--dimension: 0 is outside [1, 16]");
    refuses("sobol --name ''", "--name: '' is not a name");
    for (const std::string name : {"double", "printf", "INT64_MAX", "UINT8_C", "_Bool", "a__b"})
        refuses("sobol --name " + name, "--name: '" + name + "' is a word of C or C++");
    for (const std::string name : {"gl_x", "samplerCube", "uimage2D", "a__b", "Texture2DArray",
                                   "RWBuffer", "min16float3", "uint64_t", "dispatch"})
        refuses("sobol --language glsl --name " + name, "--name: '" + name + "' is a word of GLSL");
    EXPECT_EQ(box.shell("stipple emit sobol --language glsl --name sampler_of_pixels").code, 0);
    refuses("sobol --name a__b", "choose another\n");
    refuses("sobol --name double", "--name: 'double' is a word of C or C++");
    refuses("sobol --name sample --language hlsl", "--name: 'sample' is a word of HLSL");
    refuses("halton --name index --language python", "'index' is a name that the code uses itself");
    refuses("halton --scramble owen --language glsl", "--scramble: owen takes double precision");
    refuses("hammersley -n 2^32 --language hlsl", "--count: 4294967296 is beyond the 32 bits");
    refuses("jittered -n 2^50", "--count: 1125899906842624 is more than 4398046511104");
    refuses("sobol -w disk:method=rejection", "--warp disk: method rejection cannot be emitted");
    refuses("sobol -w hemisphere:axis=[1,0,0]", "--warp hemisphere: axis 1,0,0 cannot be emitted");
    refuses("sobol -w disk:orientation=[2,1]", "--orientation: cannot be emitted for disk");
    refuses("sobol -w torus-surface", "torus-surface cannot be emitted; these can be: cone, disk");
    refuses("sobol -w owen", "the scramble owen cannot be emitted");
    refuses("sobol -d 3 -w disk", "disk");
    refuses("sobol extra", "unexpected argument 'extra'");
}

}  // namespace stipple::testing::emit_test
