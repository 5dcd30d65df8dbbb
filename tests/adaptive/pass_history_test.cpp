#include "renderer/adaptive/pass_history.h"

#include <gtest/gtest.h>

namespace quartet {
namespace {

TEST(PassHistory, KeepsEveryPassOfARunOfUsualLength) {
  PassHistory history;
  for (std::uint32_t pass = 1; pass <= PassHistory::most_records; ++pass) {
    history.push({.pass = pass}, {});
    ASSERT_EQ(history.passes(), pass);
    ASSERT_EQ(history.records().size(), pass);
  }
}

TEST(PassHistory, ALongRunIsThinnedEvenlyAndKeepsItsLastPass) {
  PassHistory history;
  for (std::uint32_t pass = 1; pass <= 100'000; ++pass) {
    SampleCosts::Work work;
    work.units[5] = 10 * std::uint64_t(pass);
    history.push({.pass = pass,
                  .samples = 3 * std::uint64_t(pass),
                  .seconds = 0.25 * pass,
                  .truth = {.error = 1.0 / pass}},
                 work);
    ASSERT_LE(history.records().size(), PassHistory::most_records);
    ASSERT_EQ(history.records().back().pass, pass);
  }
  SampleCosts costs;
  costs.add(5, 20, 10.0);
  history.charge(costs, false);
  const auto records = history.records();
  EXPECT_GT(records.size(), PassHistory::most_records / 2);
  const std::uint32_t stride = records[1].pass - records[0].pass;
  for (std::size_t i = 0; i + 1 < records.size(); ++i) {
    EXPECT_EQ(records[i].pass, stride * (i + 1));
    EXPECT_EQ(records[i].samples, 3 * std::uint64_t(records[i].pass));
    EXPECT_EQ(records[i].truth.error, 1.0 / records[i].pass);
    EXPECT_EQ(records[i].tracing_seconds, 5.0 * records[i].pass);
    EXPECT_EQ(records[i].seconds, 5.25 * records[i].pass);
  }
}

TEST(PassHistory, AllRecordsAreChargedByTheNewestCosts) {
  PassHistory history;
  SampleCosts costs;
  costs.add(0, 1, 1.0);
  SampleCosts::Work work;
  for (std::uint32_t pass = 1; pass <= 3; ++pass) {
    work.units[0] += 4;
    history.push({.pass = pass, .seconds = 0.5}, work);
    history.charge(costs, true);
    EXPECT_EQ(history.back().seconds, 4.0 * pass + 0.5);
  }
  costs.add(0, 1, 2.0);
  history.charge(costs, false);
  EXPECT_EQ(history.records()[0].seconds, 6.5);
  EXPECT_EQ(history.records()[2].seconds, 18.5);
  EXPECT_EQ(history.records()[2].tracing_seconds, 18.0);
}

}  // namespace
}  // namespace quartet
