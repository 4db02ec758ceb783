"""Makes all tables of wear; see README.md.   pip install numpy scipy mpmath; python generate.py"""
import finish
import periodic

if __name__ == '__main__':
    periodic.decay()
    periodic.levels()
    periodic.both()
    finish.main()
