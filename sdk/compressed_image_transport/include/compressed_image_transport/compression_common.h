#pragma once

namespace compressed_image_transport {

enum compressionFormat { UNDEFINED = -1, JPEG, PNG };

}  // namespace compressed_image_transport
