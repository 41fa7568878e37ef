#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "simulation/surfaces/lighting.hpp"
#include "simulation/surfaces/texture.hpp"

namespace window_ingress::simulation {

/// A corner of a quadrilateral as the renderer wants it.
struct Vertex {
  std::array<float, 3> position;        ///< window frame [m]
  std::array<float, 2> uv;              ///< texture coordinates [tiles]
  std::array<unsigned char, 4> colour;  ///< red, green, blue, 255
};

/// How a surface looks.
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

/// Parts of a convex polygon within and beyond a half space; either may be empty. What lies within 1e-9 m of
/// the plane belongs to both.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const HalfSpace& half_space);

/// Quadrilaterals by texture, shaded once, with the light that was set when they were added: cut where the
/// border of sun and shadow runs over them.
class Mesh {
 public:
  explicit Mesh(const Lighting& lighting) : lighting_(lighting) {}
  void setLighting(const Lighting& lighting) { lighting_ = lighting; }
  const Lighting& lighting() const { return lighting_; }
  /// Where what is added from now on stands: inside the house it can be seen from outside through the opening
  /// only.
  void setIndoors(bool indoors) { indoors_ = indoors; }

  /// A parallelogram with a corner at `origin` and the sides `u` and `v`; its face is towards u x v. The
  /// texture is laid along u and v in its tile size, starting from `uv0_m`.
  void addQuad(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
               const Surface& surface, const Eigen::Vector2d& uv0_m = Eigen::Vector2d::Zero());
  /// As `addQuad`, the texture stretched over the whole of it, its upper end at v.
  void addPicture(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                  const Surface& surface);
  void addBox(const Eigen::AlignedBox3d& box, const Surface& surface);
  /// Flat and convex, at least four corners, its face where they run anticlockwise.
  void addPolygon(const Polygon& polygon, const Surface& surface);

  /// Four vertices a quadrilateral; the last two may be the same.
  struct Batch {
    bool indoors;
    Texture texture;
    bool operator<(const Batch& other) const {
      return std::make_pair(indoors, texture) < std::make_pair(other.indoors, other.texture);
    }
  };
  const std::map<Batch, std::vector<Vertex>>& batches() const { return batches_; }

 private:
  void emit(const Polygon& polygon, const Surface& surface, const Eigen::Vector3d& brightness);

  Lighting lighting_;
  bool indoors_ = false;
  std::map<Batch, std::vector<Vertex>> batches_;
};

}  // namespace window_ingress::simulation
