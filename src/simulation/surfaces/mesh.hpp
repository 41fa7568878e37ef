#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "simulation/surfaces/texture.hpp"

namespace window_ingress::simulation {

/// All points p with normal . p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
  double beyond(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

/// The sun, ambient light, and a soft light from one side; gives the brightness of a face by its normal.
struct Lighting {
  Eigen::Vector3d towards_sun = Eigen::Vector3d::UnitZ();
  double sun = 0.5;
  double ambient = 0.5;
  Eigen::Vector3d towards_lamp = Eigen::Vector3d::UnitZ();
  double lamp = 0.0;
  Eigen::Vector3d sun_colour = Eigen::Vector3d::Ones();   ///< colour of the sunlight
  Eigen::Vector3d soft_colour = Eigen::Vector3d::Ones();  ///< colour of all other light
  /// A convex part of space, where all half spaces hold: only there is sun, or with `shadow` only there is
  /// none. Empty: sun everywhere.
  std::vector<HalfSpace> region = {};
  bool shadow = false;

  /// Brightness of each channel, for a face in the sun or in the shadow.
  Eigen::Vector3d brightness(const Eigen::Vector3d& normal, bool in_sun) const {
    const double sky = 1.0 + 0.08 * normal.z();
    const double soft = ambient * sky + lamp * std::max(0.0, normal.dot(towards_lamp));
    const double direct = in_sun ? sun * std::max(0.0, normal.dot(towards_sun)) : 0.0;
    return soft * soft_colour + direct * sun_colour;
  }

  /// Whether the sun reaches faces with this normal.
  bool reaches(const Eigen::Vector3d& normal) const { return sun > 0.0 && normal.dot(towards_sun) > 0.0; }
  bool sunlit(const Eigen::Vector3d& point) const {
    const bool within = std::all_of(region.begin(), region.end(),
                                    [&](const HalfSpace& half) { return half.beyond(point) <= 0.0; });
    return within != shadow;
  }

  /// This lighting without the sun.
  Lighting inShadow() const {
    Lighting light = *this;
    light.sun = 0.0;
    return light;
  }
};

/// A corner of a quadrilateral in the renderer's format.
struct Vertex {
  std::array<float, 3> position;        ///< window frame [m]
  std::array<float, 2> uv;              ///< texture coordinates [tiles]
  std::array<unsigned char, 4> colour;  ///< red, green, blue, 255
};

/// Appearance of a surface.
struct Surface {
  Texture texture = Texture::kPlain;
  Eigen::Vector3d colour = Eigen::Vector3d::Constant(200.0);  ///< red, green, blue in white light, 0..255
};

/// A corner of a flat polygon.
struct Corner {
  Eigen::Vector3d position;  ///< [m]
  Eigen::Vector2d uv;        ///< [tiles]
};
using Polygon = std::vector<Corner>;

/// Quadrilaterals by texture. Each is shaded once, with the light set when it was added, and cut along the
/// border of sun and shadow.
class Mesh {
 public:
  explicit Mesh(const Lighting& lighting) : lighting_(lighting) {}
  void setLighting(const Lighting& lighting) { lighting_ = lighting; }
  const Lighting& lighting() const { return lighting_; }
  /// Place of the faces added from now on: from outside, indoor faces are visible through the opening only.
  void setIndoors(bool indoors) { indoors_ = indoors; }

  /// A parallelogram with a corner at `origin` and the sides `u` and `v`, facing u x v. The texture lies
  /// along u and v in its tile size, starting from `uv0_m`.
  void addQuad(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
               const Surface& surface, const Eigen::Vector2d& uv0_m = Eigen::Vector2d::Zero());
  /// As `addQuad`, with the texture stretched over the whole parallelogram; its upper end is at v.
  void addPicture(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                  const Surface& surface);
  void addBox(const Eigen::AlignedBox3d& box, const Surface& surface);
  /// A flat, convex polygon with at least four corners, facing where they run anticlockwise.
  void addPolygon(const Polygon& polygon, const Surface& surface);

  /// Four vertices per quadrilateral; the last two may be equal.
  struct Batch {
    bool indoors;
    Texture texture;
    bool operator<(const Batch& other) const {
      return std::tie(indoors, texture) < std::tie(other.indoors, other.texture);
    }
  };
  const std::map<Batch, std::vector<Vertex>>& batches() const { return batches_; }

 private:
  void emit(const Polygon& polygon, const Surface& surface, const Eigen::Vector3d& brightness);

  Lighting lighting_;
  bool indoors_ = false;
  std::map<Batch, std::vector<Vertex>> batches_;
};

/// Gives a mesh another lighting for a while.
class LitBy {
 public:
  LitBy(const Lighting& lighting, Mesh& mesh) : mesh_(mesh), before_(mesh.lighting()) {
    mesh.setLighting(lighting);
  }
  ~LitBy() { mesh_.setLighting(before_); }
  LitBy(const LitBy&) = delete;
  LitBy& operator=(const LitBy&) = delete;

 private:
  Mesh& mesh_;
  Lighting before_;
};

}  // namespace window_ingress::simulation
