#pragma once

#include "class_loader/registry.hpp"

#define TRUNDLE_REGISTER_CLASS(Derived, Base, number)                                                   \
  namespace {                                                                                           \
  const ::class_loader::impl::Registration<Derived, Base> class_loader_registration_##number(#Derived); \
  }
#define TRUNDLE_REGISTER_CLASS_NUMBERED(Derived, Base, number) TRUNDLE_REGISTER_CLASS(Derived, Base, number)

/** Make a class known to those who load this library; at file scope. */
#define CLASS_LOADER_REGISTER_CLASS(Derived, Base) TRUNDLE_REGISTER_CLASS_NUMBERED(Derived, Base, __COUNTER__)
#define CLASS_LOADER_REGISTER_CLASS_WITH_MESSAGE(Derived, Base, Message) CLASS_LOADER_REGISTER_CLASS(Derived, Base)
