function answer = simulate(case_, varargin)
%SIMULATE  Chip thickness, forces, torque and engagement of a case; compared with its
%   measurements, if it has any.
%
%   answer = trochoid.simulate(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('simulate', case_, varargin{:});
end
