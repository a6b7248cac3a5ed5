#include "tinsmith/verify.hpp"

#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "judge/measure.hpp"
#include "judge/topology.hpp"

namespace tinsmith {

Certificate measure(const Tin& tin, const Samples& samples) {
  Certificate certificate;
  certificate.vertices = tin.vertices.size();
  certificate.triangles = tin.triangles.size();
  const PlanMesh mesh = plan_mesh(tin, samples.frame);
  measure_areas(mesh, samples.frame, certificate);
  measure_border(mesh, measure_topology(mesh, certificate), certificate);
  measure_coverage(mesh, samples, certificate);
  return certificate;
}

Certificate verify(const std::vector<std::string>& inputs, const std::string& mesh_path,
                   const InputOptions& options, const Progress& progress) {
  const RasterField field(inputs, options);
  return measure(read_mesh(mesh_path), {field, field.frame(), 0, progress});
}

}  // namespace tinsmith
