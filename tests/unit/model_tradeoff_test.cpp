// Which models no other beats in both error and cost.

#include "brdf/study/model_tradeoff.hpp"

#include <gtest/gtest.h>

namespace sklar::brdf {
namespace {

TEST(ModelTradeoff, MarksWhatNoOtherBeats) {
  std::vector<ModelTradeoffRow> rows = {{.bytes = 100, .batch_ns = 5, .log1p_mae = 0.5},
                                        {.bytes = 200, .batch_ns = 4, .log1p_mae = 0.6},
                                        {.bytes = 300, .batch_ns = 9, .log1p_mae = 0.1},
                                        {.bytes = 300, .batch_ns = 8, .log1p_mae = 0.1},
                                        {.bytes = 50, .error = "none"}};
  mark_best(rows);
  const std::vector<bool> bytes = {true, false, true, true, false}, ns = {true, true, false, true, false};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].best_for_bytes, bytes[i]) << i;
    EXPECT_EQ(rows[i].best_for_ns, ns[i]) << i;
  }
}

}  // namespace
}  // namespace sklar::brdf
