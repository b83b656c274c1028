// Sparse symmetric systems of 3 × 3 blocks, by Cholesky decomposition in an order of least fill: nodes of minimum
// degree first, as in George and Liu, "The Evolution of the Minimum Degree Ordering Algorithm" (1989).
#pragma once

#include <array>
#include <utility>
#include <vector>

namespace trundle::navigation {

using Block = std::array<double, 9>;   // row by row
using Triple = std::array<double, 3>;  // of a right side or a solution

class BlockCholesky {
 public:
  // pairs: rows and columns (i < j) of the blocks beside the diagonal, each once.
  BlockCholesky(int count, std::vector<std::pair<int, int>> pairs);

  // Solves the system; false where it is not positive definite.
  //
  // diagonal: a block for each row; beside: the blocks (i, j) of the pairs, in their order; right: the right side,
  // which becomes the solution.
  bool solve(const std::vector<Block>& diagonal, const std::vector<Block>& beside, std::vector<Triple>& right);

 private:
  struct Column {
    std::vector<int> rows;  // places in the order, ascending, all after the column's own
    std::vector<Block> blocks;
    Block diagonal;
  };

  void order();
  Block& block_at(Column& column, int row);
  bool decompose();

  std::vector<std::pair<int, int>> pairs_;
  std::vector<int> place_;       // of a row of the system in the order
  std::vector<Column> columns_;  // in the order
};

}  // namespace trundle::navigation
