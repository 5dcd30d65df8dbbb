#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace quartet {

/// A number with its confidence interval.
struct Interval {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;

  bool contains(double value) const { return low <= value && value <= high; }
};

/// The number that Student's t with so many degrees of freedom exceeds in absolute value with
/// probability `p`, in (0, 1): the half-width of a two-sided interval at confidence 1 − p, in
/// standard errors.
double student_quantile(double p, int degrees);

/// Probability that Student's t lies at least this far from 0.
double student_p(double t, int degrees);

/// Of at least one value.
double mean_of(std::span<const double> values);

/// The middle of the values, the mean of two where there is no single one; NaN if one of them is.
double median(std::vector<double> values);

/// The largest of at least `left_out` + 1 values, once so many larger ones are left out; none is
/// NaN.
float largest_but(std::vector<float> values, std::size_t left_out);

/// Of the mean of independent values, two-sided, at confidence 1 − p, by Student's t. Of a single
/// value nothing is known: its interval has no ends.
Interval mean_interval(std::span<const double> values, double p);

/// Of the geometric mean of independent values above 0, the same of their logarithms.
Interval geometric_interval(std::span<const double> values, double p);

/// Probability that the mean of independent values would lie at least so far from `truth` if that
/// was their expectation; 1 if all are equal to it, 0 if all are equal to something else.
double mean_p(std::span<const double> values, double truth);

/// What each of at least two independent pairs contributes to Σ numerators / Σ denominators, so
/// that mean_interval() and mean_p() of these numbers are those of the ratio: the pseudovalues of
/// the jackknife (Quenouille 1956; Tukey 1958). The mean of the pairs' own ratios is off where
/// denominators are noisy, however many pairs there are; the ratio of the sums is off by a term in
/// 1/pairs, which the jackknife takes away.
std::vector<double> ratio_pseudovalues(std::span<const double> numerators,
                                       std::span<const double> denominators);

/// Of a share, of which `hits` of `trials` were seen: Wilson 1927. Of no trials: 0 to 1.
Interval share_interval(double hits, double trials, double p);

/// The false-alarm rate that each of so many tests may have so that all together stay at `family`:
/// Šidák 1967.
double sidak(double family, double tests);

}  // namespace quartet
