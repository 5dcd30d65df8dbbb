#include "renderer/view/estimator_look.h"

namespace quartet {
namespace {

// The divergences of means and those of samples are kin: the same hue and mark, the latter darker
// and broken. Those that look at a pixel's own samples are dashed; what is no method is grey, or
// black.
constexpr EstimatorLook contrast_look{{208, 124, 0}, {242, 166, 66}, MarkShape::dot, Dash::solid};
constexpr EstimatorLook kl_look{{0, 114, 178}, {94, 178, 246}, MarkShape::square, Dash::solid};
constexpr EstimatorLook chi2_look{{0, 146, 108}, {60, 206, 158}, MarkShape::triangle, Dash::solid};
constexpr EstimatorLook hellinger_look{
    {196, 88, 150}, {232, 130, 184}, MarkShape::wedge, Dash::solid};
constexpr EstimatorLook confidence_look{
    {204, 71, 0}, {255, 128, 84}, MarkShape::diamond, Dash::dashed};
constexpr EstimatorLook variance_look{{128, 82, 34}, {206, 160, 112}, MarkShape::dot, Dash::dashed};
constexpr EstimatorLook half_buffer_look{
    {150, 136, 0}, {240, 228, 66}, MarkShape::square, Dash::dashed};
constexpr EstimatorLook cycles_look{
    {84, 72, 190}, {158, 148, 255}, MarkShape::triangle, Dash::dashed};
constexpr EstimatorLook rigau_kl_look{
    {0, 62, 122}, {52, 128, 206}, MarkShape::square, Dash::dash_dot};
constexpr EstimatorLook rigau_chi2_look{
    {0, 88, 60}, {24, 150, 108}, MarkShape::triangle, Dash::dash_dot};
constexpr EstimatorLook rigau_hellinger_look{
    {122, 32, 92}, {186, 84, 146}, MarkShape::wedge, Dash::dash_dot};
constexpr EstimatorLook oracle_look{{0, 0, 0}, {255, 255, 255}, MarkShape::cross, Dash::solid};
constexpr EstimatorLook uniform_look{{88, 88, 88}, {222, 226, 232}, MarkShape::cross, Dash::dashed};
constexpr EstimatorLook uniform_clamp_look{
    {140, 140, 140}, {150, 156, 166}, MarkShape::cross, Dash::dotted};

}  // namespace

const EstimatorLook& look_of(EstimatorId estimator) {
  switch (estimator) {
    case EstimatorId::contrast:
      return contrast_look;
    case EstimatorId::kl:
      return kl_look;
    case EstimatorId::chi2:
      return chi2_look;
    case EstimatorId::hellinger:
      return hellinger_look;
    case EstimatorId::confidence:
      return confidence_look;
    case EstimatorId::variance:
      return variance_look;
    case EstimatorId::half_buffer:
      return half_buffer_look;
    case EstimatorId::cycles:
      return cycles_look;
    case EstimatorId::rigau_kl:
      return rigau_kl_look;
    case EstimatorId::rigau_chi2:
      return rigau_chi2_look;
    case EstimatorId::rigau_hellinger:
      return rigau_hellinger_look;
    case EstimatorId::oracle:
      return oracle_look;
    case EstimatorId::uniform:
      return uniform_look;
    case EstimatorId::uniform_clamp:
      return uniform_clamp_look;
    case EstimatorId::oracle_expected:
    case EstimatorId::lottery:
    case EstimatorId::endless:
      break;  // controls are in no chart
  }
  return uniform_look;
}

}  // namespace quartet
