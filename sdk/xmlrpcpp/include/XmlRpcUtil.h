#pragma once

#include "xmlrpcpp/XmlRpcUtil.h"
