"""PyKDL's chains: joints, segments, forward kinematics, Jacobians."""

import math

import PyKDL
from PyKDL import Chain, ChainFkSolverPos_recursive, Frame, Jacobian, JntArray, Joint, Rotation, Segment, Vector


def show(value):
    """Round numbers, at any depth."""
    if isinstance(value, float):
        return round(value, 6) + 0.0
    if isinstance(value, Frame):
        return [[show(value[r, c]) for c in range(4)] for r in range(3)]
    return [show(value[i]) for i in range(3 if isinstance(value, Vector) else 6)]


joints = [
    Joint(Joint.RotX), Joint("b", Joint.RotY), Joint("c", Joint.RotZ), Joint(Joint.TransX), Joint(Joint.TransY),
    Joint("f", Joint.TransZ), Joint("fixed"), Joint(), Joint("g", Vector(1, 2, 3), Vector(0, 2, 0), Joint.RotAxis),
    Joint(Vector(0, 0, 1), Vector(1, 1, 0), Joint.TransAxis), Joint("h", Joint.RotZ, 2.0, 0.5),
    Joint("i", Joint.TransX, -1.0, 0.25),
]  # fmt: skip
for joint in joints:
    print(joint.getName(), joint.getTypeName(), show(joint.JointAxis()), show(joint.JointOrigin()))
    print(show(joint.pose(0.3)), show(joint.twist(0.7)))
print(joints[1].getType() == Joint.RotY, Joint(joints[1]).getName())

segment = Segment("upper", joints[2], Frame(Rotation.RotX(0.2), Vector(0.5, 0, 0.1)))
print(segment.getName(), segment.getJoint().getName(), show(segment.getFrameToTip()))
print(show(segment.pose(0.4)), show(segment.twist(0.4, 2.0)), Segment(joints[0]).getName())

chain = Chain()
for number, joint in enumerate(joints):
    chain.addSegment(
        Segment(f"s{number}", joint, Frame(Rotation.RPY(0.1 * number, -0.2, 0.3), Vector(0.3, 0.02 * number, 0.1)))
    )
print(chain.getNrOfJoints(), chain.getNrOfSegments(), chain.getSegment(3).getName())
q = JntArray(chain.getNrOfJoints())
for number in range(q.rows()):
    q[number] = math.sin(number + 1.0)
print(q.rows(), q.columns(), [show(q[number]) for number in range(q.rows())])
solver, tip = ChainFkSolverPos_recursive(chain), Frame()
for until in (-1, 0, 1, 5, chain.getNrOfSegments()):
    print(until, solver.JntToCart(q, tip, until), show(tip))
print(solver.JntToCart(q, tip, 99), solver.JntToCart(JntArray(2), tip))
jacobian = Jacobian(chain.getNrOfJoints())
print(PyKDL.ChainJntToJacSolver(chain).JntToJac(q, jacobian), jacobian.rows(), jacobian.columns())
for row in range(6):
    print([show(jacobian[row, column]) for column in range(jacobian.columns())])
print(show(jacobian.getColumn(2)))
twice = Chain(chain)
twice.addChain(chain)
print(twice.getNrOfSegments(), twice.getNrOfJoints(), chain.getNrOfSegments())
small = JntArray(2)
small[0], small[1] = 1.5, -2.0
other = JntArray(small)
print(small, other == small, JntArray(3) == small)
other[1] = 3.0
print(small[1], other)
other.resize(1)
print(other.rows())
result = JntArray(2)
PyKDL.Add(small, JntArray(small), result)
print(result)
PyKDL.Subtract(small, result, result)
print(result)
PyKDL.Multiply(small, 2.0, result)
print(result)
PyKDL.Divide(small, 2.0, result)
print(result, PyKDL.Equal(small, small), PyKDL.Equal(small, result))
PyKDL.SetToZero(result)
print(result)
for wrong in (lambda: small[2], lambda: small[-1], lambda: JntArray("x")):
    try:
        wrong()
    except Exception as error:
        print(type(error).__name__)
