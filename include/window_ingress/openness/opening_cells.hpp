#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::openness {

/// The opening as a grid of cells: through which of them the sight went into depth, and where it ended in the
/// plane. A sight that goes through a cell shows that nothing closes it; as the vehicle moves, the same point
/// of the room is seen through one cell after another.
class OpeningCells {
 public:
  static constexpr int kSide = 6;
  struct Range {
    int first, last;  ///< both included
  };

  /// \param place within the opening, 0 to 1, right and down; outside of it nothing happens
  void see(const Eigen::Vector2d& place, double log_odds);
  /// The same of whole cells in which nothing is seen that ends: what is there is as deep as the point beside
  /// them at least. It takes several points, on several images, and none of them in the plane.
  /// \param cells as in `InteriorPoint::beside`
  void seeBeside(std::uint64_t cells, double log_odds);
  /// Takes what was seen beside the points of one image.
  void endImage();
  void clear() { *this = OpeningCells(); }

  struct Share {
    double open = 0.0, closed = 0.0;  ///< parts of the cells that are needed, 0 to 1
    double least_quarter_open = 0.0;  ///< of its four quarters, the one that was seen open least
    double least_side_open = 0.0;     ///< of its outermost rows and columns, the one that was seen open least
  };
  /// \param needed size of the middle that must be free
  Share shareOf(const geometry::OpeningSize& needed, const geometry::OpeningSize& opening) const;

 private:
  double openOf(const Range& across, const Range& down) const;
  bool isClosed(int x, int y) const;
  bool isOpen(int x, int y) const;
  bool isBetweenOpen(int x, int y) const;
  static constexpr float kMax = 12.0f;
  static constexpr float kSure = 2.0f;  ///< log odds by which a cell is one or the other
  static constexpr int kMinBeside = 3;  // points on one image
  static constexpr int kMinImages = 5;
  std::array<float, kSide * kSide> open_{}, closed_{};
  std::array<int, kSide * kSide> deep_{}, shallow_{};  // points beside the cell, on this image
  std::array<int, kSide * kSide> images_{};            // on which the cell was beside deep points alone
};

}  // namespace window_ingress::openness
