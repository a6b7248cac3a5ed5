#include "simplify/labour.hpp"

namespace tinsmith {

// Measured on the sample terrain, one thread, as thousands of triangles (seconds, RMSE in metres):
//
//   refinements  patience  roughness        2 m                 10 m                 50 m
//             0       1.5          -  734.6 (2.9, 1.04)   219.2 (1.40, 4.62)   34.2 (0.54, 19.6)
//             1         1        0.6  727.8 (4.2, 0.66)   212.1 (1.73, 3.65)   32.7 (0.68, 15.9)
//             8       1.6        0.6  695.9 (7.1, 0.64)   198.7 (2.56, 3.67)   29.9 (1.00, 16.4)
//
// A patience of 4 in the last row takes 1 to 2 % off the triangles, and at 50 m the RMSE is above greedy
// insertion's. At 5 m a roughness of 0.62 takes 2.1 % off the RMSE for 1.3 % more triangles and 2 % more time.
Labour labour_of(Effort effort) {
  switch (effort) {
    case Effort::kFast:
      return {0, 1.5};
    case Effort::kDefault:
      return {1, 1, 0.6};
    case Effort::kBest:
      return {8, 1.6, 0.6};
  }
  return {};
}

}  // namespace tinsmith
