#pragma once

#include "xmlrpcpp/XmlRpc.h"
