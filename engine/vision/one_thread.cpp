// Sets OpenCV's number of threads.
#include "engine/vision/one_thread.hpp"

#include <opencv2/core/utility.hpp>

namespace nezumi {

bool use_one_thread() {
    cv::setNumThreads(1);
    return true;
}

}  // namespace nezumi
