# Libraries of the kit's packages, each with those that it needs, its own first; header-only packages have none.
set(_TRUNDLE_LIBRARIES_rostime rostime)
set(_TRUNDLE_LIBRARIES_rosconsole rosconsole rostime)
set(_TRUNDLE_LIBRARIES_xmlrpcpp xmlrpcpp)
set(_TRUNDLE_LIBRARIES_roslib roslib)
set(_TRUNDLE_LIBRARIES_roscpp roscpp rosconsole rostime xmlrpcpp)
