#include "kinegraph/solvers/interface/options.h"

#include <gtest/gtest.h>

#include <set>

#include "kinegraph/solvers/nlp_solver.h"

using namespace kinegraph;

TEST(OptMethod, EachHasOneNameAndALine) {
  std::set<OptMethod> methods;
  std::set<std::string> names;
  for (const OptMethodName& row : kOptMethods) {
    methods.insert(row.method);
    names.insert(row.name);
    EXPECT_EQ(optMethodName(row.method), row.name);
    EXPECT_TRUE(std::string(row.doc).ends_with('.')) << row.name;
  }
  EXPECT_EQ(methods.size(), std::size(kOptMethods));
  EXPECT_EQ(names.size(), std::size(kOptMethods));
}

TEST(OptMethod, ThoseThatAreThereHaveANameInTheTable) {
  for (const OptMethod method : availableMethods()) {
    EXPECT_TRUE(std::any_of(std::begin(kOptMethods), std::end(kOptMethods),
                            [&](const OptMethodName& row) { return row.method == method; }));
  }
}
