// SPDX-License-Identifier: MIT
#include <fftw3.h>
#include <pthread.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <new>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "math/fourier/fft.hpp"
#include "math/fourier/grid_cells.hpp"

namespace stipple {
namespace {

fftw_complex* as_fftw(double* p) { return reinterpret_cast<fftw_complex*>(p); }

/// Lock for FFTW's planner, which is not thread-safe. fork() waits for this lock: held by another
/// thread, it would stay locked in the child.
std::mutex& planner() {
    static std::mutex mutex;
    static const int waits = ::pthread_atfork([] { planner().lock(); }, [] { planner().unlock(); },
                                              [] { planner().unlock(); });
    static_cast<void>(waits);
    return mutex;
}

struct DestroyPlan {
    void operator()(fftw_plan plan) const {
        const std::lock_guard lock(planner());
        fftw_destroy_plan(plan);
    }
};

class OwnedPlan {
  public:
    /// @param make creates the plan; called with the planner locked
    template <class Make>
    explicit OwnedPlan(const Make& make) {
        const std::lock_guard lock(planner());
        plan_.reset(make());
        if (!plan_) throw std::bad_alloc();
    }
    [[nodiscard]] fftw_plan get() const { return plan_.get(); }

  private:
    std::unique_ptr<fftw_plan_s, DestroyPlan> plan_;
};

}  // namespace

struct LineTransform::Plan {
    Kind kind;
    OwnedPlan fftw;
};

LineTransform::LineTransform(Kind kind, std::size_t length, Planning planning) {
    const auto n = static_cast<int>(length);
    const unsigned effort = planning == Planning::measured ? FFTW_MEASURE : FFTW_ESTIMATE;
    const GridCells line(2 * length + 2);
    double* p = line.get();
    plan_ = std::make_unique<Plan>(
        Plan{kind, OwnedPlan([&] {
                 return kind == Kind::real
                            ? fftw_plan_dft_r2c_1d(n, p, as_fftw(p), effort)
                            : fftw_plan_dft_1d(n, as_fftw(p), as_fftw(p), FFTW_FORWARD, effort);
             })});
}

LineTransform::~LineTransform() = default;

void LineTransform::execute(double* lines, std::size_t spacing, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i, lines += spacing)
        if (plan_->kind == Kind::real)
            fftw_execute_dft_r2c(plan_->fftw.get(), lines, as_fftw(lines));
        else
            fftw_execute_dft(plan_->fftw.get(), as_fftw(lines), as_fftw(lines));
}

struct GroupTransform::Plan {
    OwnedPlan forward;
    OwnedPlan backward;
};

GroupTransform::GroupTransform(const std::vector<int>& shape, double* values, double* spectrum) {
    const int rank = static_cast<int>(shape.size());
    plan_ = std::make_unique<Plan>(Plan{
        OwnedPlan([&] {
            return fftw_plan_dft_r2c(rank, shape.data(), values, as_fftw(spectrum), FFTW_ESTIMATE);
        }),
        OwnedPlan([&] {
            return fftw_plan_dft_c2r(rank, shape.data(), as_fftw(spectrum), values, FFTW_ESTIMATE);
        })});
}

GroupTransform::~GroupTransform() = default;
void GroupTransform::forward() const { fftw_execute(plan_->forward.get()); }
void GroupTransform::backward() const { fftw_execute(plan_->backward.get()); }

std::string fft_library() { return fftw_version; }

std::string_view fft_licence() {
    return "this program, with FFTW in it, under the GPL, version 2 or later";
}

void read_wisdom(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored) && !ignored) return;
    const std::string text = read_file(path);
    const std::lock_guard lock(planner());
    if (fftw_import_wisdom_from_string(text.c_str()) == 0)
        fail_with_hint(ErrorKind::input, "if there is no such file, a new one is written",
                       "{}: not a wisdom file of {}", path, fftw_version);
}

std::string wisdom_text() {
    const std::lock_guard lock(planner());
    const std::unique_ptr<char, void (*)(void*)> text(fftw_export_wisdom_to_string(), std::free);
    if (!text) throw std::bad_alloc();
    return std::string(text.get()) + "\n";
}

}  // namespace stipple
