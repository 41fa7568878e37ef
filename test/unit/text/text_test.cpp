#include "window_ingress/text/text.hpp"

#include <gtest/gtest.h>

namespace window_ingress::parameters::text_test {

TEST(WithoutNumbers, ReasonsThatDifferInNumbersOnlyAreOne) {
  EXPECT_EQ(withoutNumbers("stamp is 0.75 s old, limit 0.5 s"), "stamp is # s old, limit # s");
  EXPECT_EQ(withoutNumbers("3.50 s old, limit 0.5 s"), withoutNumbers("-14 s old, limit +1 s"));
  EXPECT_NE(withoutNumbers("3 s old"), withoutNumbers("3 s ahead"));
}

TEST(WithoutNumbers, KeepsAllElse) {
  EXPECT_EQ(withoutNumbers("v1.2.3. Then 7"), "v# Then #");
  EXPECT_EQ(withoutNumbers("four-sided, a - b + c"), "four-sided, a - b + c");
  EXPECT_EQ(withoutNumbers("-"), "-");
  EXPECT_EQ(withoutNumbers(""), "");
}

}  // namespace window_ingress::parameters::text_test
