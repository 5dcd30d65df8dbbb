#pragma once

#include "renderer/view/views.h"

namespace quartet {

// Each is what its file ends in; row_of_view() in views.cpp knows which is whose.
extern const ViewRow image_view;
extern const ViewRow heatmap_view;
extern const ViewRow error_view;
extern const ViewRow variance_view;
extern const ViewRow stop_state_view;
extern const ViewRow rejected_view;
extern const ViewRow difference_view;
extern const ViewRow true_error_view;
extern const ViewRow reference_view;

}  // namespace quartet
