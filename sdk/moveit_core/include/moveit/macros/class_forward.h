#pragma once

#include <memory>

/** Names of shared pointers to a class. */
#define MOVEIT_DECLARE_PTR(Name, Type)                  \
  typedef std::shared_ptr<Type> Name##Ptr;              \
  typedef std::shared_ptr<const Type> Name##ConstPtr;   \
  typedef std::weak_ptr<Type> Name##WeakPtr;            \
  typedef std::weak_ptr<const Type> Name##ConstWeakPtr; \
  typedef std::unique_ptr<Type> Name##UniquePtr;        \
  typedef std::unique_ptr<const Type> Name##ConstUniquePtr;
#define MOVEIT_CLASS_FORWARD(C) \
  class C;                      \
  MOVEIT_DECLARE_PTR(C, C)
#define MOVEIT_STRUCT_FORWARD(C) \
  struct C;                      \
  MOVEIT_DECLARE_PTR(C, C)
