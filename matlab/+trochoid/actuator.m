function answer = actuator(case_, varargin)
%ACTUATOR  Transfer function (gain and two poles) of an actuator from a measured step.
%
%   answer = trochoid.actuator(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('actuator', case_, varargin{:});
end
