#pragma once

#include "xmlrpcpp/XmlRpcException.h"
#include "xmlrpcpp/XmlRpcValue.h"
