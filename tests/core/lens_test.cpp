#include <gtest/gtest.h>

#include <turnscan/core/lens.hpp>

namespace turnscan {
namespace {

constexpr BrownConrady<double> kLens{0.09, -0.27, 0.001, -0.002, 0.05};

TEST(BrownConrady, GivesTheModelsFormula) {
  double x = 0.3, y = -0.2;
  const double r2 = 0.13, radial = 1.0 + 0.09 * r2 - 0.27 * r2 * r2 + 0.05 * r2 * r2 * r2;
  distort(kLens, x, y);
  EXPECT_NEAR(x, 0.3 * radial + 2.0 * 0.001 * 0.3 * -0.2 - 0.002 * (r2 + 2.0 * 0.09), 1e-15);
  EXPECT_NEAR(y, -0.2 * radial + 0.001 * (r2 + 2.0 * 0.04) - 2.0 * 0.002 * 0.3 * -0.2, 1e-15);
}

TEST(BrownConrady, IsTheSameForFloatsAndForVectorsOfThem) {
  using Lanes = float __attribute__((vector_size(16)));
  constexpr BrownConrady<float> kFloats{0.09f, -0.27f, 0.001f, -0.002f, 0.05f};
  Lanes xs{0.3f, -0.1f, 0.0f, 0.7f}, ys{-0.2f, 0.4f, 0.0f, 0.6f};
  for (int lane = 0; lane < 4; ++lane) {
    float x = xs[lane], y = ys[lane];
    Lanes a = xs, b = ys;
    distort<TangentialProduct::kShared>(kFloats, x, y);
    distort<TangentialProduct::kShared>(kFloats, a, b);
    EXPECT_EQ(a[lane], x);
    EXPECT_EQ(b[lane], y);
    double exact_x = double(xs[lane]), exact_y = double(ys[lane]);
    distort(kLens, exact_x, exact_y);
    EXPECT_NEAR(double(x), exact_x, 1e-6);
    EXPECT_NEAR(double(y), exact_y, 1e-6);
  }
}

TEST(BrownConrady, WithADenominatorOfOneTheRationalFormIsBrowns) {
  double x = 0.3, y = -0.2, a = x, b = y, c = x, d = y;
  distort(kLens, x, y);
  distort_rational(kLens, a, b);
  distort_any(kLens, c, d);
  EXPECT_NEAR(a, x, 1e-15);
  EXPECT_NEAR(b, y, 1e-15);
  EXPECT_EQ(c, x);
  EXPECT_EQ(d, y);
}

TEST(BrownConrady, TheRationalFormIsTheSameForFloatsAndForVectorsOfThem) {
  using Lanes = float __attribute__((vector_size(16)));
  constexpr BrownConrady<float> kRational{0.55f, -0.02f, 0.001f, -0.002f, -0.003f,
                                          0.89f, 0.09f,  -0.01f, 2.0f};
  Lanes xs{0.3f, -0.1f, 0.0f, 1.7f}, ys{-0.2f, 0.4f, 0.0f, 0.6f};
  for (int lane = 0; lane < 4; ++lane) {
    float x = xs[lane], y = ys[lane];
    Lanes a = xs, b = ys;
    distort_rational<TangentialProduct::kShared>(kRational, x, y);
    distort_rational<TangentialProduct::kShared>(kRational, a, b);
    EXPECT_EQ(a[lane], x);
    EXPECT_EQ(b[lane], y);
  }
}

}  // namespace
}  // namespace turnscan
