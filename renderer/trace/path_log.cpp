#include "renderer/trace/path_log.h"

namespace quartet {
namespace {

class LogObserver : public NoObserver {
 public:
  explicit LogObserver(PathLog& log) : log_(log) {}

  void missed(glm::vec3 environment, float weight) {
    PathVertex& vertex = log_.vertices.emplace_back();
    vertex.throughput = next_throughput_;
    found(vertex, environment, weight);
  }
  void vertex(const Surface& surface, float distance, glm::vec3 throughput) {
    PathVertex& vertex = log_.vertices.emplace_back();
    vertex.surface = surface;
    vertex.distance = distance;
    vertex.throughput = throughput;
  }
  void emitted(glm::vec3 radiance, float weight) { found(last(), radiance, weight); }
  void occluded(const Ray&) { last().light_sampled = true; }
  void direct(const LightSample& light, const BsdfValue& bsdf, float weight, glm::vec3 reflected) {
    last().direct = DirectLight{light, bsdf, weight, last().throughput * reflected};
  }
  void scattered(const BsdfSample& sample, glm::vec3 direction) {
    last().scattered = sample;
    last().direction = direction;
    next_throughput_ = last().throughput * sample.weight;
  }
  void survival(float probability) {
    last().survival = probability;
    next_throughput_ /= probability;
  }
  void ended(PathEnd end) { log_.end = end; }

 private:
  PathVertex& last() { return log_.vertices.back(); }

  static void found(PathVertex& vertex, glm::vec3 radiance, float weight) {
    vertex.emitted = FoundLight{radiance, weight, weight * vertex.throughput * radiance};
  }

  PathLog& log_;
  glm::vec3 next_throughput_{1.0f};
};

}  // namespace

PathLog log_path(const TraceScene& scene, const RenderSettings& settings, int x, int y,
                 std::uint32_t index) {
  PathLog log;
  LogObserver observer(log);
  const CameraRays camera(settings.camera, settings.width, settings.height);
  const auto pixel = std::uint32_t(y) * std::uint32_t(settings.width) + std::uint32_t(x);
  Sampler sampler(settings.seed, pixel, index, settings.sampler);
  const Ray ray = camera.ray(x, y, sampler.next());
  log.radiance =
      settings.integrator == IntegratorId::mis
          ? trace_path<true>(scene, ray, sampler, settings.max_depth, observer, settings.roulette)
          : trace_path<false>(scene, ray, sampler, settings.max_depth, observer, settings.roulette);
  return log;
}

}  // namespace quartet
