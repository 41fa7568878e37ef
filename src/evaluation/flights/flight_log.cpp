#include "evaluation/flights/flight_log.hpp"

#include <algorithm>

#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

std::string targetOf(const FlightRecord& record) {
  if (!record.has_target) return std::string(8, ',');
  return formatted(",%d,%.3f,%.4f,%.4f,%.4f,%.5f,%.4f,%.5f", record.sign_trusted ? 1 : 0,
                   record.target_age_sec, record.target_error_m.x(), record.target_error_m.y(),
                   record.target_error_m.z(), record.target_yaw_error_rad, record.target_sigma_m,
                   record.target_yaw_sigma_rad);
}

std::string imageOf(const FlightRecord& record) {
  if (!record.image) return std::string(7, ',');
  const ImageRecord& image = *record.image;
  return formatted(",%.4f,%.5f,%d,%.4f,%.4f,%.2f,%.2f", image.time_sec, image.yaw_rad,
                   image.sign_trusted ? 1 : 0, image.opening_width_m, image.opening_height_m,
                   image.left_side_px, image.right_side_px);
}

std::string withoutCommas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

}  // namespace

void writeCsv(const FlightLog& log, std::ostream& out) {
  out << "time_s,state,x_m,y_m,z_m,heading_rad,vx_mps,vy_mps,vz_mps,set_x_mps,set_y_mps,set_z_mps,set_yaw_"
         "radps,detected,trusted,age_s,error_x_m,error_y_m,error_z_m,error_yaw_rad,sigma_m,sigma_yaw_rad,"
         "image_s,image_yaw_rad,image_trusted,image_width_m,image_height_m,image_left_px,image_right_px,"
         "predicted_miss_m,sighting,reason\n";
  for (const auto& r : log.records)
    out << formatted("%.4f,%s,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%d", r.time_sec,
                     toString(r.state), r.position_m.x(), r.position_m.y(), r.position_m.z(), r.heading_rad,
                     r.velocity_mps.x(), r.velocity_mps.y(), r.velocity_mps.z(), r.setpoint_mps.x(),
                     r.setpoint_mps.y(), r.setpoint_mps.z(), r.setpoint_yaw_rate_radps, r.detected ? 1 : 0)
        << targetOf(r) << imageOf(r) << ","
        << (r.predicted_miss_m > 0.0 ? formatted("%.4f", r.predicted_miss_m) : "") << ","
        << withoutCommas(r.sighting) << "," << withoutCommas(r.reason) << "\n";
}

}  // namespace window_ingress::evaluation
