#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::openness {

/// The opening as a grid of cells: through which of them lines of sight went into depth, and where they ended
/// in the plane. A line of sight through a cell shows that nothing closes it; as the vehicle moves, the same
/// point of the room is seen through one cell after another.
class OpeningCells {
 public:
  static constexpr int kSide = 6;

  /// \param place within the opening, 0 to 1, right and down; a place outside is ignored
  void see(const Eigen::Vector2d& place, double log_odds);
  /// The same for whole cells filled by a region without edges, which is at least as deep as the point beside
  /// it. It takes several points, on several images, and none of them in the plane.
  /// \param cells as in `InteriorPoint::beside`
  void seeBeside(std::uint64_t cells, double log_odds);
  /// Evaluates the calls of `seeBeside` for one image.
  void endImage();
  void clear() { *this = OpeningCells(); }

  struct Share {
    double open = 0.0, closed = 0.0;  ///< of the needed cells, 0 to 1
    double least_quarter_open = 0.0;  ///< of the four quarters, the one with the least part open
    double least_side_open = 0.0;     ///< of the outermost rows and columns, the one with the least part open
  };
  /// \param needed size of the middle that must be free
  Share shareOf(const geometry::OpeningSize& needed, const geometry::OpeningSize& opening) const;

 private:
  template <typename Value>
  using Grid = Eigen::Array<Value, kSide, kSide, Eigen::RowMajor>;

  static constexpr float kMax = 12.0f;
  static constexpr float kSure = 2.0f;  ///< log odds at which a cell is open or closed
  static constexpr int kMinBeside = 3;  // points in one image
  static constexpr int kMinImages = 5;
  Grid<float> open_ = Grid<float>::Zero(), closed_ = Grid<float>::Zero();
  Grid<int> deep_ = Grid<int>::Zero(), shallow_ = Grid<int>::Zero();  // points beside the cell, in this image
  Grid<int> images_ = Grid<int>::Zero();  // in which only deep points were beside the cell
};

}  // namespace window_ingress::openness
