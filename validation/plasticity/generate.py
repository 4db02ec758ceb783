"""Makes all tables of plasticity; see README.md.   pip install numpy scipy mpmath; python generate.py"""
import exact
import layered_paraboloid
import periodic

if __name__ == '__main__':
    periodic.main()
    exact.main_paraboloid()
    exact.main_wave()
    layered_paraboloid.main()
