#include "app/window/lab_driver.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/terminal/home_folder.h"
#include "renderer/adaptive/memory_need.h"
#include "renderer/files/picture.h"
#include "ui/window/pictures/read_out.h"

namespace quartet {

LabDriver::LabDriver(LabState state, const GlFunctions& gl, std::function<void()> wake,
                     const std::filesystem::path& reference_cache)
    : textures_(gl),
      window_(std::move(state),
              [this](std::size_t slot, const DisplayImage& image) {
                return textures_.upload(slot, image);
              }),
      session_(wake),
      loader_(wake),
      references_(reference_work(reference_cache, [this] { return session_.busy(); }), wake),
      reference_(references_.latest()),
      evaluations_(evaluation_work(), wake),
      rejected_samples_(rejected_work(), wake),
      equaliser_(equalise_work(), wake),
      exports_(export_status, wake) {
}

LabDriver::~LabDriver() {
  session_.close();
  loader_.close();
  references_.close();
  evaluations_.close();
  rejected_samples_.close();
  equaliser_.close();
  exports_.close();
}

void LabDriver::drop(const std::filesystem::path& file) {
  if (is_picture(file)) {
    load_reference(file);
  } else {
    load(file.string());
  }
}

void LabDriver::load_reference(const std::filesystem::path& file, const std::string& layer) {
  const LabRequest& wanted = window_.state().request;
  if (wanted.store.scene) {
    ask_for_reference({wanted.store.scene, wanted.store.settings, file, 0, layer});
  } else {
    window_.say(Message::Kind::error,
                fmt::format("{}: there is no scene yet that it could belong to", file.string()));
  }
}

void LabDriver::begin_frame(ImguiScreen& screen, float natural_scale) {
  if (window_.rescale(natural_scale)) {
    screen.forget_fonts();
  }
  screen.begin_frame();
}

bool LabDriver::draw(double seconds) {
  take_scene();
  take_export();
  keep_reference_current();
  snapshot_ = session_.latest();
  const bool answered = reference_->input == reference_request_;
  const bool pending =
      !answered || reference_->output.activity == ReferenceStatus::Activity::loading;
  const LabOrders orders =
      window_.draw({snapshot_, session_.status(), loader_.busy(), exports_.busy(),
                    answered ? reference_->output : ReferenceStatus(), pending,
                    evaluations_.latest()->output, keep_equalising(), rejected(), seconds});
  obey(orders);
  const bool resized = keep_size_within_memory();
  submit();
  evaluate();
  look_for_rejected();
  return orders.animate || orders.load_scene || orders.save || orders.cancel || resized;
}

/// A scene that was loaded, if its pictures fit the memory.
void LabDriver::take_scene() {
  const auto loaded = loader_.poll();
  if (!loaded) {
    return;
  }
  if (!loaded->scene) {
    window_.scene_failed(loaded->error);
    return;
  }
  const Scene& scene = loaded->scene->scene();
  const std::string refusal = memory_refusal(scene.width, scene.height, lane_count);
  if (refusal.empty()) {
    window_.scene_loaded(loaded->scene, loaded->asked);
  } else {
    window_.scene_failed(fmt::format("{}: its film of {}", loaded->asked, refusal));
  }
}

void LabDriver::obey(const LabOrders& orders) {
  if (orders.cancel) {
    cancel();
  }
  if (orders.load_scene) {
    load_typed(*orders.load_scene);
  }
  if (orders.save && snapshot_) {
    save(*orders.save);
  }
  if (orders.reference) {
    load_typed_reference(*orders.reference);
  }
  if (orders.equalise) {
    equalise(*orders.equalise);
  } else if (orders.stop_equalising) {
    equaliser_.submit({});
    equalise_request_ = 0;
  }
}

void LabDriver::load_typed(const std::string& scene) {
  try {
    loader_.load(typed_path(scene).string());
  } catch (const std::exception& error) {
    window_.scene_failed(error.what());
  }
}

void LabDriver::load_typed_reference(const ReferenceOrder& order) {
  const LabRequest& wanted = window_.state().request;
  try {
    ask_for_reference(
        {wanted.store.scene, wanted.store.settings, typed_path(order.file.string()), order.spp});
  } catch (const std::exception& error) {
    window_.say(Message::Kind::error, error.what());
  }
}

/// What is being loaded or saved.
void LabDriver::cancel() {
  if (loader_.busy()) {
    loader_.cancel();
    window_.scene_failed("");
  }
  if (exports_.busy()) {
    exports_.cancel();
  }
  if (reference_->output.activity == ReferenceStatus::Activity::loading) {
    const LabRequest& wanted = window_.state().request;
    ask_for_reference({wanted.store.scene, wanted.store.settings, {}, 0});
  }
  window_.say(Message::Kind::notice, "cancelled");
}

/// A size that was typed or chosen and would not fit the memory gives way to the one before.
/// Returns whether it did.
bool LabDriver::keep_size_within_memory() {
  RenderSettings& wanted = window_.state().request.store.settings;
  const glm::ivec2 size(wanted.width, wanted.height);
  if (size == fitting_size_) {
    return false;
  }
  const std::string refusal = memory_refusal(size.x, size.y, lane_count);
  if (refusal.empty() || fitting_size_ == glm::ivec2(0)) {
    fitting_size_ = size;
    return false;
  }
  wanted.width = fitting_size_.x;
  wanted.height = fitting_size_.y;
  window_.say(Message::Kind::error, refusal);
  return true;
}

void LabDriver::submit() {
  const LabRequest& wanted = window_.state().request;
  // Whoever looks at the truth waits until it is known whether there is one.
  const bool lacks_truth =
      !wanted.lanes.reference &&
      std::ranges::any_of(wanted.lanes.settings, [](const LaneSettings& settings) {
        return estimator(settings.estimator).needs_reference;
      });
  if (wanted.store.scene && !lacks_truth && wanted != submitted_) {
    submitted_ = wanted;
    request_ = session_.submit(wanted);
  }
}

void LabDriver::ask_for_reference(ReferenceRequest request) {
  asked_reference_ = request;
  said_error_.clear();
  reference_request_ = references_.submit(std::move(request));
}

/// Another view wants another reference, which the cache may hold.
void LabDriver::keep_reference_current() {
  const LabRequest& wanted = window_.state().request;
  const ReferenceRequest view{wanted.store.scene, wanted.store.settings, {}, 0};
  if (wanted.store.scene && !same_view(view, asked_reference_)) {
    ask_for_reference(view);
  }
  reference_ = references_.latest();
  const std::string& error = reference_->output.error;
  if (reference_->input == reference_request_ && error != said_error_) {
    said_error_ = error;
    if (!error.empty()) {
      window_.say(Message::Kind::error, error);
    }
  }
  const std::shared_ptr<const Reference>& reference = reference_->output.reference;
  if (reference_->input == reference_request_ && reference != said_of_) {
    said_of_ = reference;
    if (reference && !reference->notes.empty()) {
      window_.say(Message::Kind::notice, fmt::format("{}: {}", reference->path.filename().string(),
                                                     fmt::join(reference->notes, "; ")));
    }
  }
}

void LabDriver::equalise(const EqualiseOrder& order) {
  const LabRequest& wanted = window_.state().request;
  EqualiseRequest request{wanted.store, wanted.lanes.settings, {}, wanted.lanes.reference};
  request.store.memory /= 2;
  request.budget.passes = order.passes;
  request.budget.spp = order.spp;
  request.budget.seconds = order.seconds;
  if (order.error) {
    request.budget.error = ErrorTarget{wanted.lanes.metric, *order.error};
  }
  equalised_ = request;
  equalise_request_ = equaliser_.submit(std::move(request));
}

/// How far it has come; at its end the lanes get the thresholds that were found.
EqualiseProgress LabDriver::keep_equalising() {
  const auto latest = equaliser_.latest();
  if (equalise_request_ == 0 || latest->input != equalise_request_) {
    return {equalise_request_ == 0 ? 0 : equalised_.lane_settings.size(), 0};
  }
  const EqualiseStatus& status = latest->output;
  if (!status.done) {
    return {status.lanes, status.calibrations.size()};
  }
  equalise_request_ = 0;
  std::vector<LaneSettings>& lanes = window_.state().request.lanes.settings;
  for (std::size_t i = 0; i < std::min(lanes.size(), status.calibrations.size()); ++i) {
    // What the user has changed meanwhile stays.
    if (lanes[i] == equalised_.lane_settings[i]) {
      lanes[i] = status.calibrations[i].settings;
    }
  }
  window_.say(status.error.empty() ? Message::Kind::notice : Message::Kind::error,
              equalise_text(equalised_, status));
  return {};
}

/// All metrics of what is shown, once the lanes rest.
void LabDriver::evaluate() {
  if (!snapshot_ || session_.status().activity != SessionStatus::Activity::idle) {
    return;
  }
  const std::shared_ptr<const Reference>& reference = reference_->output.reference;
  const bool measured = reference && snapshot_->reference.get() == &reference->image;
  EvaluationInput input{measured ? snapshot_ : nullptr, measured ? reference : nullptr};
  if (input.snapshot != evaluated_.snapshot || input.reference != evaluated_.reference) {
    evaluated_ = input;
    evaluation_request_ = evaluations_.submit(std::move(input));
  }
}

/// All lanes take the same samples of a pixel, so that the first rejected one is the same in all
/// that have got as far.
void LabDriver::look_for_rejected() {
  const auto pixel = read_out_pixel(window_.state(), snapshot_.get());
  if (!pixel) {
    return;
  }
  const auto at = std::size_t(pixel->y) * std::size_t(snapshot_->width) + std::size_t(pixel->x);
  RejectedQuery query{snapshot_->scene, snapshot_->settings, *pixel, 0};
  for (const LaneSnapshot& lane : snapshot_->lanes) {
    if (!lane.rejected.empty() && lane.rejected[at] > 0) {
      query.count = std::max(query.count, lane.taken[at]);
    }
  }
  if (query.count > 0 && !query.same_pixel(rejected_query_)) {
    rejected_query_ = query;
    rejected_request_ = rejected_samples_.submit(std::move(query));
  }
}

std::optional<RejectedSample> LabDriver::rejected() const {
  const auto latest = rejected_samples_.latest();
  const auto pixel = read_out_pixel(window_.state(), snapshot_.get());
  const bool current =
      pixel && latest->input == rejected_request_ &&
      rejected_query_.same_pixel({snapshot_->scene, snapshot_->settings, *pixel, 0});
  return current ? latest->output : std::nullopt;
}

bool LabDriver::settled() const {
  const bool lanes = !loader_.busy() && !exports_.busy() && window_.state().request == submitted_ &&
                     snapshot_ && snapshot_->request == request_ &&
                     snapshot_->pass >= submitted_.lanes.pass;
  if (!lanes || reference_request_ == 0) {
    return lanes;
  }
  const ReferenceStatus& reference = reference_->output;
  if (reference_->input != reference_request_ ||
      reference.activity != ReferenceStatus::Activity::idle) {
    return false;
  }
  if (!reference.reference) {
    return true;
  }
  const auto evaluation = evaluations_.latest();
  return submitted_.lanes.reference && evaluation->input == evaluation_request_ &&
         evaluation->output.complete && evaluation->output.snapshot == snapshot_;
}

std::string LabDriver::error() const {
  const std::string lanes = session_.status().error;
  return lanes.empty() ? said_error_ : lanes;
}

/// The newest export ends the one under way.
void LabDriver::save(const ExportForm& form) {
  const std::shared_ptr<const Reference>& reference = reference_->output.reference;
  const bool measured = reference && snapshot_->reference.get() == &reference->image;
  exports_.order({snapshot_, window_.state().view, form, window_.state().scene,
                  measured ? reference : nullptr});
}

void LabDriver::take_export() {
  const std::optional<ExportStatus> status = exports_.poll();
  if (!status) {
    return;
  }
  const auto& [done, error] = *status;
  if (error.empty()) {
    window_.say(Message::Kind::notice, fmt::format("saved into {}{}", done.folder.string(),
                                                   done.lacks.empty() ? "" : "; " + done.lacks));
  } else {
    window_.say(Message::Kind::error, error);
  }
}

}  // namespace quartet
