#include "svd.hpp"

template class Eigen::JacobiSVD<Eigen::MatrixXd>;
