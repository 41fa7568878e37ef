#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace window_ingress::geometry {

/// Four image points [px], x right and y down.
///
/// *Canonical order*: top left, top right, bottom right, bottom left as seen in the image (clockwise on the
/// screen), side i running from corner i to corner i + 1: top, right, bottom, left.
using Quadrilateral = std::array<Eigen::Vector2d, 4>;

enum Corner { kTopLeft = 0, kTopRight = 1, kBottomRight = 2, kBottomLeft = 3 };
enum Side { kTop = 0, kRight = 1, kBottom = 2, kLeft = 3 };

/// Cross product of two vectors in the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool isFinite(const Quadrilateral& quad);

/// Area by the shoelace formula [px^2]: positive when clockwise on the screen, as canonical order is.
double signedArea(const Quadrilateral& quad);
double rootArea(const Quadrilateral& quad);  ///< root of the area, for either winding [px]

/// Strictly convex and free of crossings, for either winding.
bool isConvex(const Quadrilateral& quad);

/// The same corners in canonical order, from any start corner and either winding. The first corner is the one
/// with the smallest x + y. Nothing if the corners are not finite or not strictly convex in cyclic order.
std::optional<Quadrilateral> canonical(const Quadrilateral& quad);

Eigen::Vector2d centroid(const Quadrilateral& quad);              ///< mean of the corners [px]
std::array<double, 4> sideLengths(const Quadrilateral& quad);     ///< top, right, bottom, left [px]
double meanSide(const Quadrilateral& quad);                       ///< mean length of the sides [px]
std::array<double, 4> interiorAngles(const Quadrilateral& quad);  ///< at each corner [rad]

/// Mean horizontal over mean vertical side length; 0 if the vertical sides have no length.
double aspectRatio(const Quadrilateral& quad);

/// Distance of the corner that differs most from its counterpart [px].
double furthestCorner(const Quadrilateral& a, const Quadrilateral& b);

/// True if the point lies in a convex quadrilateral or on its border.
bool contains(const Quadrilateral& quad, const Eigen::Vector2d& point);

/// Area of the intersection over area of the union of two convex quadrilaterals, 0 to 1.
double intersectionOverUnion(const Quadrilateral& a, const Quadrilateral& b);

}  // namespace window_ingress::geometry
