function answer = dynamics(case_, varargin)
%DYNAMICS  Time-domain simulation of cutter, table and actuator while they cut, with runout.
%
%   answer = trochoid.dynamics(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('dynamics', case_, varargin{:});
end
