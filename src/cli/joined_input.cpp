// SPDX-License-Identifier: MIT
#include "cli/joined_input.hpp"

#include "core/error.hpp"

namespace stipple::cli {

JoinedInput::JoinedInput(std::vector<std::string> paths, Open open)
    : paths_(std::move(paths)), open_(std::move(open)) {
    open_next();
}

bool JoinedInput::open_next() {
    if (opened_ == paths_.size()) return false;
    const std::string& path = paths_[opened_];
    stream_ = open_(path);
    if (opened_++ == 0) {
        dimension_ = stream_->dimension();
        provenance_ = stream_->provenance();
        provenance_.shard.clear();
        provenance_.command.clear();
        provenance_.count = 0;
    }
    if (stream_->dimension() != dimension_)
        fail(ErrorKind::input, "{}: --concat: its points have {} coordinates, those of {} have {}",
             path, stream_->dimension(), paths_[0], dimension_);
    if (stream_->provenance().domain != provenance_.domain)
        fail(ErrorKind::input, "{}: --concat: its points are on {}, those of {} on {}", path,
             stream_->provenance().domain, paths_[0], provenance_.domain);
    return stream_->next_set();
}

std::size_t JoinedInput::read(std::span<double> rows) {
    const std::size_t wanted = rows.size() / dimension_;
    std::size_t got = 0;
    while (got < wanted && !ended_) {
        const std::size_t more =
            stream_->read(rows.subspan(got * dimension_, (wanted - got) * dimension_));
        got += more;
        if (got < wanted) ended_ = !stream_->next_set() && !open_next();
    }
    return got;
}

}  // namespace stipple::cli
