// A grid of values that remembers where it was written to, so that emptying it and reading it cost
// what was drawn and not what could be.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/Scan.h"

namespace heft {

template <typename Value>
class Layer {
 public:
  Layer(int n_columns, int n_rows)
      : n_columns_(n_columns),
        n_rows_(n_rows),
        values_(static_cast<std::size_t>(n_columns) * static_cast<std::size_t>(n_rows)),
        touched_(static_cast<std::size_t>(n_rows), {n_columns, 0}) {}

  int n_columns() const { return n_columns_; }
  int n_rows() const { return n_rows_; }

  /// The columns of a row that may hold something else than Value{}.
  Span touched(int row) const { return touched_[static_cast<std::size_t>(row)]; }

  const Value* row(int row) const { return values_.data() + start(row); }

  /// The first of the columns begin to end of a row, to be written to.
  Value* write(int row, int begin, int end) {
    Span& span = touched_[static_cast<std::size_t>(row)];
    span = {std::min(span.begin, begin), std::max(span.end, end)};
    return values_.data() + start(row) + begin;
  }

  void clear() {
    for (int y = 0; y < n_rows_; ++y) {
      Span& span = touched_[static_cast<std::size_t>(y)];
      if (!span.empty())
        std::fill_n(values_.data() + start(y) + span.begin, span.end - span.begin, Value{});
      span = {n_columns_, 0};
    }
  }

 private:
  std::size_t start(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_columns_);
  }

  int n_columns_, n_rows_;
  std::vector<Value> values_;
  std::vector<Span> touched_;
};

}  // namespace heft
