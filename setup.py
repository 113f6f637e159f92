# The Python package beside the generated messages; catkin runs this, nobody else should.
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["otter_nav"], package_dir={"": "python"}))
