#include "renderer/measure/metrics.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include "renderer/files/srgb.h"

namespace quartet {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

double value(MetricId id, const RadianceImage& test, const RadianceImage& reference) {
  return metric(id).compute(test, reference);
}

RadianceImage even_noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<float> radiance(2.0f);
  RadianceImage image(width, height);
  for (glm::vec3& c : image.pixels()) {
    c = {radiance(random), radiance(random), radiance(random)};
  }
  return image;
}

/// The message of the std::invalid_argument that a call throws; empty if it throws none.
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Metrics, TableIsInTheOrderOfItsKeysWithoutDuplicates) {
  std::set<std::string_view> ids;
  for (std::size_t i = 0; i < metrics().size(); ++i) {
    const Metric& row = metrics()[i];
    EXPECT_EQ(row.key, MetricId(i));
    EXPECT_EQ(&metric(row.key), &row);
    EXPECT_EQ(&find_metric(row.id), &row);
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_FALSE(row.label.empty() || row.definition.empty() || row.map_quantity.empty()) << row.id;
  }
}

TEST(Metrics, ErrorsAreWhatTheMetricIsTheMeanSquareOf) {
  std::set<MetricId> found;
  for (const Metric& row : metrics()) {
    if (row.errors == nullptr) {
      continue;
    }
    found.insert(row.key);
    SCOPED_TRACE(row.id);
    // Of a picture larger than the regions a side, and of one with empty regions.
    for (const auto& [width, height] : {std::pair{23, 17}, {3, 2}}) {
      const RadianceImage truth = even_noise(width, height, 1);
      const RadianceImage a = even_noise(width, height, 2);
      const RadianceImage b = even_noise(width, height, 3);
      RadianceImage middle(width, height);
      for (std::size_t i = 0; i < middle.size(); ++i) {
        middle.pixels()[i] = 0.5f * (a.pixels()[i] + b.pixels()[i]);
      }
      const auto of_a = row.errors(a, truth);
      const auto of_b = row.errors(b, truth);
      const auto of_middle = row.errors(middle, truth);
      double squares = 0.0;
      for (std::size_t i = 0; i < of_a.size(); ++i) {
        squares += double(of_a[i]) * double(of_a[i]);
        EXPECT_NEAR(of_middle[i], 0.5f * (of_a[i] + of_b[i]), 1e-5f) << "they are linear";
      }
      const double error = row.compute(a, truth);
      EXPECT_NEAR(squares / double(of_a.size()), error, 1e-6 * error);
    }
  }
  EXPECT_EQ(found, (std::set{MetricId::mse, MetricId::relmse, MetricId::relmse_regions}));
}

TEST(Metrics, UnknownOneListsTheLegalOnes) {
  const std::string message = message_of([] { find_metric("ssim"); });
  EXPECT_NE(message.find("'ssim'"), std::string::npos) << message;
  for (const Metric& row : metrics()) {
    EXPECT_NE(message.find(row.id), std::string::npos) << message;
  }
}

// One pixel whose channels are off by 0.1, 0 and −0.3.
TEST(Metrics, OfOnePixelByHand) {
  const RadianceImage test(1, 1, {0.6f, 0.25f, 0.7f});
  const RadianceImage reference(1, 1, {0.5f, 0.25f, 1.0f});
  const double tolerance = 1e-6;
  EXPECT_NEAR(value(MetricId::mse, test, reference), (0.01 + 0.09) / 3, tolerance);
  EXPECT_NEAR(value(MetricId::rmse, test, reference), std::sqrt(0.1 / 3), tolerance);
  EXPECT_NEAR(value(MetricId::relmse, test, reference), (0.01 / 0.26 + 0.09 / 1.01) / 3, tolerance);
  EXPECT_NEAR(value(MetricId::relmse_trimmed, test, reference), (0.01 / 0.26 + 0.09 / 1.01) / 3,
              tolerance)
      << "0.1 % of three channels is none";
  EXPECT_NEAR(value(MetricId::mape, test, reference), (0.1 / 0.51 + 0.3 / 1.01) / 3, tolerance);
  EXPECT_NEAR(value(MetricId::smape, test, reference), (0.2 / 1.11 + 0.6 / 1.71) / 3, tolerance);
  const double red = srgb_encode(0.6) - srgb_encode(0.5);
  const double blue = srgb_encode(0.7) - 1.0;
  EXPECT_NEAR(value(MetricId::psnr, test, reference),
              10 * std::log10(3 / (red * red + blue * blue)), 1e-4);
}

TEST(Metrics, OfHalfThePixelsOffAreHalfOfAllOff) {
  const RadianceImage reference(64, 200, glm::vec3(0.5f));
  RadianceImage all(64, 200, glm::vec3(0.75f));
  RadianceImage half = reference;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 64; ++x) {
      half.at(x, y) = all.at(x, y);
    }
  }
  for (const MetricId id : {MetricId::mse, MetricId::relmse, MetricId::mape, MetricId::smape}) {
    EXPECT_NEAR(value(id, half, reference), 0.5 * value(id, all, reference), 1e-12);
  }
  EXPECT_NEAR(value(MetricId::rmse, half, reference), 0.25 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(value(MetricId::psnr, half, reference),
              value(MetricId::psnr, all, reference) + 10 * std::log10(2.0), 1e-6);
}

TEST(Metrics, TrimmedRelmseDropsTheLargestThousandth) {
  // 1000 pixels, 3000 errors: the largest 3 go, and a fourth would stay.
  RadianceImage reference(100, 10, glm::vec3(0.0f));
  RadianceImage test(100, 10, glm::vec3(0.1f));  // 0.01/0.01 = 1 everywhere
  test.at(17, 3) = glm::vec3(100.0f);
  EXPECT_NEAR(value(MetricId::relmse_trimmed, test, reference), 1.0, 1e-6);
  test.at(80, 9).g = 10.0f;  // 10⁴
  EXPECT_NEAR(value(MetricId::relmse_trimmed, test, reference), (2996 + 1e4) / 2997, 1e-4);
  EXPECT_NEAR(value(MetricId::relmse, test, reference), (2996 + 1e4 + 3e6) / 3000, 1e-1);
}

TEST(Metrics, RelmseOfRegionsCountsBiasAsOftenAsARegionHasPixels) {
  // Regions of 5 × 4 pixels.
  const RadianceImage truth(40, 32, glm::vec3(1.0f));
  const double off = 0.1 * 0.1 / 1.01;
  EXPECT_NEAR(value(MetricId::relmse_regions, RadianceImage(40, 32, glm::vec3(0.9f)), truth),
              20.0 * off, 1e-6);
  EXPECT_NEAR(value(MetricId::relmse, RadianceImage(40, 32, glm::vec3(0.9f)), truth), off, 1e-6);
  // One pixel that is 20 too bright makes its region 1 brighter: 20 · 1² in one of 64.
  RadianceImage firefly = truth;
  firefly.at(7, 9) += glm::vec3(20.0f);
  EXPECT_NEAR(value(MetricId::relmse_regions, firefly, truth), 20.0 / 1.01 / 64.0, 1e-6);
  const ScalarImage map = metric(MetricId::relmse_regions).map(firefly, truth);
  EXPECT_NEAR(map.at(5, 8), 20.0 / 1.01, 1e-5) << "the corner of the region";
  EXPECT_EQ(map.at(4, 8), 0.0f) << "the region beside it";
}

TEST(Metrics, RelmseOfRegionsIsThatOfPixelsForNoise) {
  // Noise of deviation 0.5 that no pixel has from another. The mean over 64 regions of 3 channels
  // is known to √(2/192), 10 %: this fails by chance in under one of 10^4 seeds.
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0f, 0.5f);
  const RadianceImage truth(160, 96, glm::vec3(3.0f));
  RadianceImage test = truth;
  for (glm::vec3& c : test.pixels()) {
    c += glm::vec3(noise(random), noise(random), noise(random));
  }
  EXPECT_NEAR(value(MetricId::relmse_regions, test, truth) / value(MetricId::relmse, test, truth),
              1.0, 0.4);
}

TEST(Metrics, PsnrLooksAtWhatADisplayShows) {
  const RadianceImage dim(8, 8, glm::vec3(1.0f));
  const RadianceImage bright(8, 8, {1.0f, 7.0f, 1e30f});
  EXPECT_EQ(value(MetricId::psnr, bright, dim), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(value(MetricId::psnr, RadianceImage(8, 8, glm::vec3(0.0f)), bright), 0.0, 1e-5)
      << "black against white: an MSE of 1";
}

// sRGB is linear up to 0.0031308 and from there on a power.
TEST(Metrics, PsnrOfDarkValuesIsThatOfTheirSrgb) {
  for (const float dark : {0.0005f, 0.0015f, 0.003f, 0.0032f, 0.005f, 0.01f, 0.02f, 0.04f, 0.05f}) {
    const RadianceImage test(3, 2, glm::vec3(dark));
    const RadianceImage black(3, 2, glm::vec3(0.0f));
    const double linear = double(dark);
    const double shown =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    EXPECT_NEAR(value(MetricId::psnr, test, black), -20.0 * std::log10(shown), 1e-4) << dark;
    EXPECT_NEAR(metric(MetricId::psnr).map(test, black).at(1, 1), shown * shown,
                1e-6 * shown * shown)
        << dark;
    EXPECT_NEAR(srgb_encode(linear), shown, 1e-12);
    EXPECT_NEAR(srgb_decode(shown), linear, 1e-6);
  }
}

TEST(Metrics, OfAPictureAgainstItselfSayNoError) {
  const RadianceImage image = even_noise(33, 21, 1);
  for (const Metric& row : metrics()) {
    EXPECT_EQ(row.compute(image, image),
              row.higher_is_better ? std::numeric_limits<double>::infinity() : 0.0)
        << row.id;
  }
}

TEST(Metrics, NoiseOfMoreSamplesIsBetter) {
  const RadianceImage reference(97, 61, glm::vec3(0.5f));
  RadianceImage noisy = even_noise(97, 61, 2);  // mean 0.5
  RadianceImage quieter = noisy;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    quieter.pixels()[i] = glm::mix(reference.pixels()[i], noisy.pixels()[i], 0.5f);
  }
  for (const Metric& row : metrics()) {
    const double more = row.compute(noisy, reference);
    const double less = row.compute(quieter, reference);
    EXPECT_EQ(less > more, row.higher_is_better) << row.id << ": " << more << ", " << less;
    if (row.scale == MetricScale::squared_error) {
      EXPECT_NEAR(less, more / 4, 1e-6 * more) << row.id;
    }
  }
}

TEST(Metrics, AgreeWithTheMeanOfTheirMap) {
  const RadianceImage test = even_noise(130, 77, 3);
  const RadianceImage reference = even_noise(130, 77, 4);
  for (const Metric& row : metrics()) {
    const ScalarImage map = row.map(test, reference);
    ASSERT_EQ(map.width(), 130);
    ASSERT_EQ(map.height(), 77);
    double sum = 0.0;
    for (const float error : map.pixels()) {
      sum += error;
    }
    const double mean = sum / double(map.size());
    const double expected = row.compute(test, reference);
    switch (row.key) {
      case MetricId::rmse:
        EXPECT_NEAR(std::sqrt(mean), expected, 1e-6);
        break;
      case MetricId::psnr:
        EXPECT_NEAR(-10 * std::log10(mean), expected, 1e-5);
        break;
      case MetricId::relmse_trimmed:
        EXPECT_GT(mean, expected);
        break;
      default:
        EXPECT_NEAR(mean, expected, 1e-5 * expected) << row.id;
    }
  }
}

TEST(Metrics, OfHugeAndTinyRadianceAreFinite) {
  const RadianceImage huge(5, 5, glm::vec3(1e38f));
  const RadianceImage tiny(5, 5, glm::vec3(1e-38f));
  for (const Metric& row : metrics()) {
    EXPECT_TRUE(std::isfinite(row.compute(huge, tiny))) << row.id;
    EXPECT_TRUE(std::isfinite(row.compute(tiny, huge))) << row.id;
  }
}

TEST(Metrics, NameThePlaceOfWhatIsNotFinite) {
  const RadianceImage good(40, 30, glm::vec3(0.5f));
  for (const float bad : {not_a_number, infinity, -infinity}) {
    RadianceImage image = good;
    image.at(37, 29).b = bad;
    for (const Metric& row : metrics()) {
      const std::string in_test = message_of([&] { row.compute(image, good); });
      EXPECT_NE(in_test.find("test picture"), std::string::npos) << row.id << ": " << in_test;
      EXPECT_NE(in_test.find("(37, 29)"), std::string::npos) << row.id << ": " << in_test;
      const std::string in_reference = message_of([&] { row.compute(good, image); });
      EXPECT_NE(in_reference.find("the reference"), std::string::npos) << row.id;
      EXPECT_NE(message_of([&] { row.map(image, good); }).find("(37, 29)"), std::string::npos);
    }
  }
}

TEST(Metrics, RefusePicturesOfDifferentSize) {
  const RadianceImage wide(40, 30, glm::vec3(0.5f));
  const RadianceImage tall(30, 40, glm::vec3(0.5f));
  for (const Metric& row : metrics()) {
    const std::string message = message_of([&] { row.compute(wide, tall); });
    EXPECT_NE(message.find("40x30"), std::string::npos) << row.id << ": " << message;
    EXPECT_NE(message.find("30x40"), std::string::npos) << row.id << ": " << message;
    EXPECT_FALSE(message_of([&] { row.map(wide, tall); }).empty()) << row.id;
    EXPECT_FALSE(message_of([&] { row.compute({}, {}); }).empty()) << row.id;
  }
}

TEST(Metrics, DoNotDependOnTheNumberOfThreads) {
  const RadianceImage test = even_noise(211, 133, 5);
  const RadianceImage reference = even_noise(211, 133, 6);
  for (const Metric& row : metrics()) {
    tbb::task_arena one(1);
    const double expected = one.execute([&] { return row.compute(test, reference); });
    const ScalarImage map = one.execute([&] { return row.map(test, reference); });
    for (const int threads : {2, 8}) {
      tbb::task_arena arena(threads);
      EXPECT_EQ(arena.execute([&] { return row.compute(test, reference); }), expected) << row.id;
      EXPECT_EQ(arena.execute([&] { return row.map(test, reference); }), map) << row.id;
    }
  }
}

TEST(Metrics, EfficiencyIsErrorBoughtPerSecond) {
  EXPECT_DOUBLE_EQ(efficiency(0.5, 4.0), 0.5);
  // Twice the time at half the error: as efficient.
  EXPECT_DOUBLE_EQ(efficiency(0.25, 8.0), efficiency(0.5, 4.0));
  EXPECT_EQ(efficiency(0.0, 4.0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace quartet
