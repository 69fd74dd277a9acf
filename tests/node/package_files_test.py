#!/usr/bin/env python3
"""Every package.xml names what its package includes, imports or starts, so that rosdep can prepare a build."""
import glob
import os
import re
import unittest
import xml.etree.ElementTree as ElementTree

import rostest

SOURCES = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'src')

# Folder or name in an include, and the rosdep key; None: of the system, optional, or without a key (the package.xml says so).
KEYS = {
    'actionlib': 'actionlib', 'topic_tools': 'topic_tools',
    'BulletDynamics': 'bullet', 'CGAL': 'cgal', 'CLI': 'cli11', 'Eigen': 'eigen', 'LinearMath': 'bullet', 'XmlRpcValue.h': 'roscpp',
    'arv.h': 'aravis-dev', 'assimp': 'assimp', 'boost': 'boost', 'btBulletDynamicsCommon.h': 'bullet', 'ceres': 'libceres-dev',
    'console_bridge': 'libconsole-bridge-dev', 'dc1394': 'libdc1394-dev', 'gtest': 'rosunit', 'image_transport': 'image_transport',
    'interactive_markers': 'interactive_markers', 'nlohmann': 'nlohmann-json-dev', 'nlopt.hpp': 'libnlopt-cxx-dev', 'opencv2': 'libopencv-dev', 'pluginlib': 'pluginlib', 'ros': 'roscpp',
    'rosbag': 'rosbag_storage', 'rviz': 'rviz', 'sqlite3.h': 'sqlite3', 'tbb': 'tbb', 'tf2_ros': 'tf2_ros', 'tinyxml2.h': 'tinyxml2', 'unsupported': 'eigen', 'urdf_model': 'liburdfdom-headers-dev',
    'urdf_parser': 'liburdfdom-dev', 'xmlrpcpp': 'roscpp', 'yaml-cpp': 'yaml-cpp', 'zlib.h': 'zlib',
    **dict.fromkeys(('benchmark', 'dlfcn.h', 'elf.h', 'fcntl.h', 'link.h', 'linux', 'malloc.h', 'mpi.h', 'mujoco', 'net', 'netdb.h', 'netinet', 'pagmo',
                     'poll.h', 'pthread.h', 'qcustomplot.h', 'sched.h', 'signal.h', 'spawn.h', 'stdlib.h', 'sys', 'unistd.h'))}
MODULES = {'actionlib': 'actionlib', 'rosbag': 'rosbag', 'roslaunch': 'roslaunch', 'roslib': 'roslib', 'rospy': 'rospy', 'rostest': 'rostest', 'yaml': 'python3-yaml'}


def key(name):
    if name.startswith('Ogre') or name == 'Overlay':
        return 'libogre-dev'
    return name if name.endswith(('_msgs', '_srvs')) else KEYS.get(name)


def found(folder, suffixes, pattern):
    for root, _, files in os.walk(folder, followlinks=True):
        for file in files:
            if file.endswith(suffixes) and '/downstream/' not in root:
                with open(os.path.join(root, file)) as text:
                    yield from re.findall(pattern, text.read(), re.MULTILINE)


class PackageFiles(unittest.TestCase):

    def declared(self, package):
        root = ElementTree.parse(os.path.join(SOURCES, package, 'package.xml')).getroot()
        return {element.text for element in root if element.tag.endswith('depend')} | {package}

    def check(self, suffixes, pattern, meaning):
        packages = [os.path.basename(os.path.dirname(file)) for file in glob.glob(SOURCES + '/*/package.xml')]
        self.assertGreater(len(packages), 10)
        for package in packages:
            with self.subTest(package):
                wanted = {meaning(name) for name in found(os.path.join(SOURCES, package), suffixes, pattern)} - {None}
                self.assertLessEqual(wanted, self.declared(package), wanted - self.declared(package))

    def test_what_is_included(self):
        def meaning(name):
            self.assertTrue(name in KEYS or key(name) or name.startswith('anthrob_'), 'what is the rosdep key of <' + name + '>?')
            return name if name.startswith('anthrob_') else key(name)
        self.check(('.h', '.cpp'), r'^ *# *include <([^/>]+(?=/)|[^/>]+\.\w+(?=>))', meaning)
        self.check(('.h', '.cpp'), r'^ *# *include "(anthrob_\w+)/', meaning)

    def test_what_is_imported(self):
        self.check('.py', r'^(?:import|from) (\w+)', lambda name: MODULES.get(name, key(name)))

    def test_what_is_started(self):
        self.check(('.launch', '.xml'), r'<node [^>]*pkg="(\w+)"', lambda name: name)


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'package_files', PackageFiles)
