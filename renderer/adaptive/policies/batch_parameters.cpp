#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

constexpr const char* as_the_authors = "0: as the policy's authors have it.";

}  // namespace

constexpr PolicyParameter first_parameter{
    .key = PolicyParameterId::first,
    .id = "first_samples",
    .word = "first",
    .label = "first samples",
    .help = "samples before the first look; 0: the policy's own",
    .tooltip = as_the_authors,
    .value = CountParameter{&Policy::first, 0, 65535}};

constexpr PolicyParameter batch_parameter{
    .key = PolicyParameterId::batch,
    .id = "batch_samples",
    .word = "batch",
    .label = "batch samples",
    .help = "samples from one look to the next; 0: the policy's own",
    .tooltip = as_the_authors,
    .value = CountParameter{&Policy::batch, 0, 65535}};

}  // namespace quartet
